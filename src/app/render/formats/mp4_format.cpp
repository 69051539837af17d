#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "app/cli/verbs.h"
#include "app/render/formats/format.h"
#include "versus/engine.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

std::string ffmpeg() {
  if (const std::optional<std::string> found = versus::find_program("ffmpeg", {})) return *found;
  throw UsageError(
      "--format mp4 needs the program ffmpeg, which is not in $PATH; install it (apt-get install "
      "ffmpeg), or choose apng or webp");
}

/// Some players fail at lower rates, so slower pictures are repeated.
constexpr double kMinRate = 10;

/// Pipes raw pictures to ffmpeg.
class Mp4Animation : public Animation {
 public:
  explicit Mp4Animation(const ReelPlan& plan) : path_(plan.path), program_(ffmpeg()) {
    const fs::path target(path_);
    aside_ = (target.parent_path() /
              ("." + target.filename().string() + "." + std::to_string(getpid()) + ".part"))
                 .string();
    for (const auto& [key, value] : entries_of(plan.origin)) {
      if (key == "Title") title_ = value;
      about_ += (about_.empty() ? "" : "\n") + key + ": " + value;
    }
  }

  ~Mp4Animation() override {
    if (pipe_ >= 0) close(pipe_);
    if (child_ > 0) waitpid(child_, nullptr, 0);
    std::error_code ignored;
    fs::remove(aside_, ignored);
  }

  void add(const Image& image, const Duration& shown) override {
    if (child_ <= 0) {
      const double rate = 1 / shown.seconds;
      rate_ = rate * std::max(1.0, std::ceil(kMinRate / rate));
      start(image.width + image.width % 2, image.height + image.height % 2);
    }
    const std::vector<std::uint8_t> pixels = even(image);
    const long repeats = std::max(1L, std::lround(shown.seconds * rate_));
    for (long i = 0; i < repeats; ++i) send(pixels);
  }

  void finish() override {
    close(pipe_);
    pipe_ = -1;
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
    child_ = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
    fs::rename(aside_, path_);
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error(program_ + " could not make " + path_ +
                             "; its messages are above, and no file is left");
  }

  /// yuv420p stores one colour per 2 x 2 pixels: repeats the last column and row of odd sizes.
  static std::vector<std::uint8_t> even(const Image& image) {
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    const std::size_t row = 3 * size(image.width);
    std::vector<std::uint8_t> pixels;
    pixels.reserve((row + 3) * size(image.height + 1));
    for (int y = 0; y < image.height + image.height % 2; ++y) {
      const auto from = image.rgb.begin() +
                        static_cast<std::ptrdiff_t>(row * size(std::min(y, image.height - 1)));
      pixels.insert(pixels.end(), from, from + static_cast<std::ptrdiff_t>(row));
      if (image.width % 2 == 1) pixels.insert(pixels.end(), pixels.end() - 3, pixels.end());
    }
    return pixels;
  }

  void start(int width, int height) {
    std::istringstream fixed(
        "-y -loglevel error -f rawvideo -pixel_format rgb24 -video_size " + std::to_string(width) +
        "x" + std::to_string(height) + " -framerate " + std::to_string(rate_) +
        " -i pipe:0 -an -c:v libx264 -crf 18 -vf scale=out_color_matrix=bt709:out_range=tv "
        "-pix_fmt yuv420p -colorspace bt709 -color_primaries bt709 -color_trc bt709 "
        "-movflags +faststart -fflags +bitexact");
    std::vector<std::string> words = {program_};
    words.insert(words.end(), std::istream_iterator<std::string>(fixed), {});
    words.insert(words.end(), {"-metadata", "title=" + title_, "-metadata", "comment=" + about_,
                               "-f", "mp4", aside_});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "a pipe cannot be made");
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[0], STDIN_FILENO);
      dup2(STDERR_FILENO, STDOUT_FILENO);  // standard output is for our results
      execv(program_.c_str(), arguments.data());
      _exit(127);
    }
    close(ends[0]);
    pipe_ = ends[1];
    if (child_ < 0)
      throw std::system_error(errno, std::generic_category(), "no process can be started");
  }

  void send(std::span<const std::uint8_t> bytes) {
    // Report a crashed ffmpeg by its exit status, not by SIGPIPE in this thread.
    sigset_t broken;
    sigemptyset(&broken);
    sigaddset(&broken, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &broken, nullptr);
    while (!bytes.empty()) {
      const ssize_t written = ::write(pipe_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  std::string path_, program_, aside_, title_, about_;
  double rate_ = 0;  // pictures per second
  pid_t child_ = -1;
  int pipe_ = -1;
};

}  // namespace

const Format kMp4Format{
    .name = "mp4",
    .extension = ".mp4",
    .what = "a film, made by ffmpeg if it is installed",
    .needs_pixels = true,
    .begin =
        [](const ReelPlan& plan) { return reel_of(plan, std::make_unique<Mp4Animation>(plan)); },
    .require = [] { static_cast<void>(ffmpeg()); },
};

}  // namespace contactscope::app
