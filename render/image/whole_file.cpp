#include "image/encoding.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace contactscope {
namespace {

[[noreturn]] void fail(const std::string& path, int error, const char* what = "cannot write") {
  throw std::filesystem::filesystem_error(what, path,
                                          std::error_code(error, std::generic_category()));
}

/// Returns 0, or the errno of a failure.
int write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

void write_whole_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  static std::atomic<unsigned> counter{0};  // encoders run on several threads
  const std::filesystem::path target(path);
  std::ostringstream name;
  name << '.' << target.filename().string() << '.' << ::getpid() << '.' << counter++ << ".part";
  const std::string aside = (target.parent_path() / name.str()).string();

  const int file = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) fail(path, errno);
  int error = write_all(file, bytes);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(aside.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(aside.c_str());
    fail(path, error);
  }
}

std::vector<std::uint8_t> read_whole_file(const std::string& path) {
  // Do not wait for the writer of a pipe.
  const int opened = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (opened < 0) fail(path, errno, "cannot read");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(::fdopen(opened, "rb"), std::fclose);
  if (!file) fail(path, errno, "cannot read");
  struct stat status {};
  if (::fstat(opened, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
    throw std::runtime_error(path + ": this is not a regular file");
  std::vector<std::uint8_t> bytes;
  std::uint8_t block[65536];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get()))
    bytes.insert(bytes.end(), block, block + count);
  if (std::ferror(file.get())) fail(path, errno, "cannot read");
  return bytes;
}

}  // namespace contactscope
