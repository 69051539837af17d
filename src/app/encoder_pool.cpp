#include "app/encoder_pool.h"

#include <algorithm>

#include "image/png.h"

namespace contactscope::app {
namespace {

// Pictures that may wait for each thread: enough that it never idles, 2.8 MB each at 1280x720.
constexpr std::size_t kWaiting = 3;

}  // namespace

EncoderPool::EncoderPool(int jobs) {
  if (jobs <= 0) jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
  for (int i = 0; i < jobs; ++i) threads_.emplace_back([this] { work(); });
}

EncoderPool::~EncoderPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void EncoderPool::rethrow_locked() {
  if (!error_) return;
  queue_.clear();
  std::rethrow_exception(error_);
}

void EncoderPool::submit(std::string path, Image image) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return error_ || queue_.size() < kWaiting * threads_.size(); });
  rethrow_locked();
  queue_.push_back({std::move(path), std::move(image)});
  lock.unlock();
  changed_.notify_all();
}

void EncoderPool::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return under_way_ == 0 && (error_ || queue_.empty()); });
  rethrow_locked();
}

std::chrono::nanoseconds EncoderPool::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

void EncoderPool::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
    if (queue_.empty()) return;
    Job job = std::move(queue_.front());
    queue_.pop_front();
    ++under_way_;
    lock.unlock();
    changed_.notify_all();

    const auto begin = std::chrono::steady_clock::now();
    std::exception_ptr error;
    try {
      write_png(job.path, job.image);
    } catch (...) {
      error = std::current_exception();
    }
    const auto time = std::chrono::steady_clock::now() - begin;

    lock.lock();
    busy_ += time;
    --under_way_;
    if (error && !error_) error_ = error;
    changed_.notify_all();
  }
}

}  // namespace contactscope::app
