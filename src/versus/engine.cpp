#include "versus/engine.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
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

/// One end of a pipe; closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  void reset(int number) {
    close();
    number_ = number;
  }
  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

struct Pipe {
  Descriptor read, write;

  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot create a pipe");
    read.reset(ends[0]);
    write.reset(ends[1]);
  }
};

/// Ignores SIGPIPE, for programs that close their input early.
class WithoutBrokenPipe {
 public:
  WithoutBrokenPipe() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignore, &before_);
  }
  ~WithoutBrokenPipe() { sigaction(SIGPIPE, &before_, nullptr); }
  WithoutBrokenPipe(const WithoutBrokenPipe&) = delete;
  WithoutBrokenPipe& operator=(const WithoutBrokenPipe&) = delete;

 private:
  struct sigaction before_ {};
};

pid_t start(const std::string& program, const std::vector<std::string>& arguments, Pipe& in,
            Pipe& out, Pipe& err) {
  std::vector<char*> list;
  list.push_back(const_cast<char*>(program.c_str()));
  for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
  if (child > 0) return child;
  setpgid(0, 0);  // so that its children are stopped with it
  dup2(in.read.get(), STDIN_FILENO);
  dup2(out.write.get(), STDOUT_FILENO);
  dup2(err.write.get(), STDERR_FILENO);
  execv(program.c_str(), list.data());
  _exit(127);
}

/// Appends the available data; closes at the end of the stream.
void read_some(Descriptor& from, std::string& to) {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(from.get(), buffer.data(), buffer.size());
  if (count > 0)
    to.append(buffer.data(), static_cast<std::size_t>(count));
  else if (count == 0 || (errno != EINTR && errno != EAGAIN))
    from.close();
}

void write_some(Descriptor& to, const std::string& text, std::size_t& written) {
  constexpr std::size_t kPiece = 65536;
  const std::size_t left = text.size() - written;
  const ssize_t count =
      left == 0 ? 0 : write(to.get(), text.data() + written, std::min(left, kPiece));
  if (count > 0) written += static_cast<std::size_t>(count);
  const bool failed = count < 0 && errno != EINTR && errno != EAGAIN;
  if (failed || written == text.size()) to.close();
}

/// The line that names an error, as interpreters print it first; else the last line with text.
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

std::string ending_of(int status, const std::string& err) {
  const std::string said = last_line(err).empty() ? "" : ": " + last_line(err);
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

Answer run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const std::string& input, double limit_seconds, std::size_t limit_bytes) {
  const WithoutBrokenPipe guard;
  Pipe in, out, err;
  const pid_t child = start(program, arguments, in, out, err);
  in.read.close();
  out.write.close();
  err.write.close();
  fcntl(in.write.get(), F_SETFL, O_NONBLOCK);

  Answer answer;
  std::string errors;
  std::size_t written = 0;
  const auto begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::string stopped;
  while (out.read.is_open() || err.read.is_open()) {
    const double left = limit_seconds - seconds();
    if (left <= 0)
      stopped = "it was stopped after " + std::to_string(static_cast<int>(limit_seconds)) + " s";
    if (answer.out.size() + errors.size() > limit_bytes)
      stopped = "it wrote more than " + std::to_string(limit_bytes >> 20) + " MB, and was stopped";
    if (!stopped.empty()) {
      kill(-child, SIGKILL);
      break;
    }
    std::array<pollfd, 3> ends{pollfd{out.read.get(), POLLIN, 0}, pollfd{err.read.get(), POLLIN, 0},
                               pollfd{in.write.get(), POLLOUT, 0}};
    poll(ends.data(), ends.size(), static_cast<int>(std::min(left, 1.0) * 1000) + 1);
    if (ends[0].revents != 0) read_some(out.read, answer.out);
    if (ends[1].revents != 0) read_some(err.read, errors);
    if (ends[2].revents != 0) write_some(in.write, input, written);
  }
  in.write.close();
  // A program that has closed its streams may use the remaining time.
  int status = 0;
  while (stopped.empty() && waitpid(child, &status, WNOHANG) == 0) {
    if (seconds() > limit_seconds) {
      stopped = "it was stopped after " + std::to_string(static_cast<int>(limit_seconds)) + " s";
      kill(-child, SIGKILL);
      break;
    }
    usleep(1000);
  }
  if (!stopped.empty()) waitpid(child, &status, 0);
  answer.said = errors;
  if (stopped.empty() && WIFEXITED(status)) answer.exit_code = WEXITSTATUS(status);
  answer.failure = stopped.empty() ? ending_of(status, errors) : stopped;
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
