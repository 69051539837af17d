#include "versus/engine.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <system_error>

namespace contactscope::versus {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kPrefix = "contactscope-engine-";

/// A file in memory; closes itself. Unlike a pipe it needs no reader while a program writes.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text = {})
      : number_(memfd_create("contactscope", MFD_CLOEXEC)) {
    for (std::size_t written = 0; written < text.size() || number_ < 0;) {
      const ssize_t count = write(number_, text.data() + written, text.size() - written);
      if (count < 0)
        throw std::system_error(errno, std::generic_category(), "cannot write a file in memory");
      written += static_cast<std::size_t>(count);
    }
    lseek(number_, 0, SEEK_SET);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(number_); }

  int get() const { return number_; }
  std::size_t size() const {
    struct stat facts {};
    return fstat(number_, &facts) == 0 ? static_cast<std::size_t>(facts.st_size) : 0;
  }
  std::string text() const {
    std::string all(size(), '\0');
    std::size_t count = 0;
    for (ssize_t more = 1; more > 0; count += static_cast<std::size_t>(std::max<ssize_t>(more, 0)))
      more = pread(number_, all.data() + count, all.size() - count, static_cast<off_t>(count));
    all.resize(count);
    return all;
  }

 private:
  int number_;
};

pid_t start(const std::string& program, const std::vector<std::string>& arguments,
            const MemoryFile& in, const MemoryFile& out, const MemoryFile& err) {
  std::vector<char*> list;
  list.push_back(const_cast<char*>(program.c_str()));
  for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
  if (child > 0) return child;
  setpgid(0, 0);  // so that its children are stopped with it
  dup2(in.get(), STDIN_FILENO);
  dup2(out.get(), STDOUT_FILENO);
  dup2(err.get(), STDERR_FILENO);
  execv(program.c_str(), list.data());
  _exit(127);
}

std::string ending_of(int status, const std::string& err) {
  const std::string line = last_line(err), said = line.empty() ? "" : ": " + line;
  if (WIFSIGNALED(status))
    return "it crashed, signal " + std::to_string(WTERMSIG(status)) + " (" +
           strsignal(WTERMSIG(status)) + ")" + said;
  if (WEXITSTATUS(status) == 127 && said.empty()) return "it could not be started";
  if (WEXITSTATUS(status) != 0)
    return "it ended with exit code " + std::to_string(WEXITSTATUS(status)) + said;
  return "";
}

std::vector<std::string> with_path(std::vector<std::string> folders) {
  const char* path = std::getenv("PATH");
  std::istringstream entries(path == nullptr ? "" : path);
  for (std::string folder; std::getline(entries, folder, ':');)
    if (!folder.empty()) folders.push_back(folder);
  return folders;
}

bool is_program(const fs::path& path) {
  return fs::is_regular_file(path) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string line, last;
  while (std::getline(lines, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (line.substr(0, line.find(' ')).ends_with("Error:")) return line;
    last = line;
  }
  return last;
}

Answer run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const std::string& input, double limit_seconds, std::size_t limit_bytes) {
  const MemoryFile in(input), out, err;
  const auto begin = Clock::now();
  const pid_t child = start(program, arguments, in, out, err);
  std::string stopped;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::duration<double>(Clock::now() - begin).count() > limit_seconds)
      stopped = "it was stopped after " + std::to_string(static_cast<int>(limit_seconds)) + " s";
    else if (out.size() + err.size() > limit_bytes)
      stopped = "it wrote more than " + std::to_string(limit_bytes >> 20) + " MB, and was stopped";
    if (!stopped.empty()) {
      kill(-child, SIGKILL);
      waitpid(child, &status, 0);
      break;
    }
    usleep(1000);
  }
  Answer answer{out.text(), err.text(), stopped};
  if (!stopped.empty()) return answer;
  if (WIFEXITED(status)) answer.exit_code = WEXITSTATUS(status);
  answer.failure = ending_of(status, answer.said);
  return answer;
}

std::optional<std::string> find_program(const std::string& name,
                                        const std::vector<std::string>& folders) {
  for (const std::string& folder : with_path(folders)) {
    const fs::path path = fs::path(folder) / name;
    if (is_program(path)) return path.string();
  }
  return std::nullopt;
}

std::optional<std::string> find_engine(const std::string& name,
                                       const std::vector<std::string>& folders) {
  return find_program(kPrefix + name, folders);
}

std::vector<std::string> own_folders() {
  std::error_code unknown;
  const fs::path self = fs::read_symlink("/proc/self/exe", unknown);
  if (unknown) return {};
  return {(self.parent_path() / "engines").string(), self.parent_path().string()};
}

std::vector<std::string> engines_found(const std::vector<std::string>& folders) {
  std::set<std::string> names;
  for (const std::string& folder : with_path(folders)) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
      const std::string file = entry.path().filename().string();
      if (file.starts_with(kPrefix) && is_program(entry.path()))
        names.insert(file.substr(std::strlen(kPrefix)));
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace contactscope::versus
