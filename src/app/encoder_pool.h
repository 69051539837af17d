#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "image/image.h"

namespace contactscope::app {

/// Writes PNG files on threads of its own, while the caller renders the next picture. At most a few
/// pictures wait, so that memory stays small when encoding is the slower part.
class EncoderPool {
 public:
  /// `jobs` threads; 0 means one less than there are processors, at least one.
  explicit EncoderPool(int jobs);
  /// Waits for what is under way; errors are lost here, so call finish() first.
  ~EncoderPool();
  EncoderPool(const EncoderPool&) = delete;
  EncoderPool& operator=(const EncoderPool&) = delete;

  /// Queues a picture; blocks while the queue is full. Throws the first error of an earlier
  /// picture.
  void submit(std::string path, Image image);
  /// Waits until all is written. Throws the first error.
  void finish();
  /// Time that the threads spent encoding and writing, summed over threads.
  std::chrono::nanoseconds busy() const;
  int threads() const { return static_cast<int>(threads_.size()); }

 private:
  struct Job {
    std::string path;
    Image image;
  };
  void work();
  void rethrow_locked();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> queue_;
  int under_way_ = 0;
  bool stopping_ = false;
  std::exception_ptr error_;
  std::chrono::nanoseconds busy_{};
  std::vector<std::thread> threads_;
};

}  // namespace contactscope::app
