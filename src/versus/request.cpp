#include "versus/request.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>

#include "core/convex_polygon.h"

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
  MemoryFile& operator=(MemoryFile&&) = delete;
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

double area_of_points(const std::vector<Vec3d>& points, const Vec3d& normal) {
  if (points.size() < 3) return 0;
  return contactscope::area_of(convex_polygon(project(points, normal)));
}

}  // namespace

void keep_queried_pairs(trace::Frame& frame) {
  std::set<std::pair<std::string, std::string>> seen;
  std::erase_if(frame.pairs, [&](const trace::Pair& pair) {
    return pair.query || !seen.emplace(pair.a, pair.b).second;
  });
}

trace::Trace request_of(const trace::Trace& whole) {
  trace::Trace request;
  request.header = whole.header;
  for (const trace::Frame& frame : whole.frames) {
    trace::Frame& requested = request.frames.emplace_back();
    requested.frame = frame.frame;
    requested.time = frame.time;
    requested.poses = frame.poses;
    requested.deformed = frame.deformed;
    requested.shapes = frame.shapes;
    requested.pairs = frame.pairs;
    keep_queried_pairs(requested);
    for (trace::Pair& pair : requested.pairs) {
      trace::Pair one;
      one.a = pair.a;
      one.b = pair.b;
      one.kind = pair.kind;
      one.state = "separated";
      pair = one;
    }
  }
  return request;
}

trace::Trace own_contacts(const trace::Trace& request) {
  lint::Solids solids;
  for (const trace::Shape& shape : request.header.shapes) solids.add(shape);
  trace::Trace answer = request;
  answer.header.scalar = "double";
  CollideOptions options;
  options.reducer = find_reducer(kDefaultReducer);
  for (trace::Frame& frame : answer.frames) {
    for (const trace::Shape& shape : frame.shapes) solids.add(shape);
    solids.deform(frame.deformed);
    for (trace::Pair& pair : frame.pairs) {
      const auto a = lint::place(solids, &frame, pair.a, {});
      const auto b = lint::place(solids, &frame, pair.b, {});
      if (!a || !b) continue;
      const Shape<double>&one = a->solid->shape(), &other = b->solid->shape();
      if (!can_collide(kind_of(one), kind_of(other))) continue;
      Manifolds<double> manifolds;
      collide(one, a->pose, other, b->pose, options, manifolds, nullptr, &pair,
              trace::Stages::none());
    }
  }
  return answer;
}

std::string to_text(const trace::Trace& trace) {
  std::string text = trace::to_json_line(trace.header) + "\n";
  for (const trace::Frame& frame : trace.frames) text += trace::to_json_line(frame) + "\n";
  return text;
}

double area_of(const trace::Manifold& manifold) {
  return area_of_points(mapped(manifold.points, &trace::Point::position), manifold.normal);
}

std::vector<Truth> truths_of(const lint::Solids& solids, const trace::Frame& frame) {
  std::vector<Truth> truths;
  for (const trace::Pair& pair : frame.pairs) {
    Truth& truth = truths.emplace_back();
    truth.a = pair.a;
    truth.b = pair.b;
    const auto a = lint::place(solids, &frame, pair.a, {});
    const auto b = lint::place(solids, &frame, pair.b, {});
    if (!a || !b) continue;
    truth.tolerance = lint::tolerance_of(*a, *b);
    if (const std::optional<lint::Separation> best = best_separation(*a, *b))
      truth.separation = best->distance;
    const std::optional<lint::OwnContacts> own = lint::own_contacts(*a, *b);
    if (!own) continue;
    if (!truth.separation) {
      // The distance is not computed for a mesh, only that they are separated.
      truth.separation = own->separation;
    } else if (own->manifolds.size() == 1) {
      const Manifold<double>& manifold = own->manifolds.front();
      truth.area =
          area_of_points(mapped(manifold.points, &ContactPoint<double>::position), manifold.normal);
    }
  }
  return truths;
}

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
