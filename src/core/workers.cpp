#include "core/workers.h"

namespace contactscope {

Workers::Workers(int count) {
  try {
    for (int worker = 1; worker < count; ++worker)
      threads_.emplace_back([this, worker] { run(worker); });
  } catch (const std::system_error&) {
    // The system gives no more threads: continue with fewer.
  }
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::for_each(int pieces, const std::function<void(int, int)>& work) {
  if (threads_.empty() || pieces <= 1) {
    for (int i = 0; i < pieces; ++i) work(i, 0);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    pieces_ = pieces;
    next_ = 0;
    error_ = nullptr;
    busy_ = count();
    ++lists_;
  }
  begun_.notify_all();
  take_part(0);
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [&] { return busy_ == 0; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

/// Main loop of a pool thread.
void Workers::run(int worker) {
  int done = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      begun_.wait(lock, [&] { return stop_ || lists_ != done; });
      if (stop_) return;
      done = lists_;
    }
    take_part(worker);
  }
}

/// A mutex is enough: a piece takes far longer than the lock that an atomic counter would save.
void Workers::take_part(int worker) {
  std::unique_lock lock(mutex_);
  while (next_ < pieces_) {
    const int i = next_++;
    lock.unlock();
    std::exception_ptr error;
    try {
      (*work_)(i, worker);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (!error) continue;
    pieces_ = next_;
    if (!error_ || i < error_at_) {
      error_ = error;
      error_at_ = i;
    }
  }
  if (--busy_ == 0) ended_.notify_all();
}

int hardware_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace contactscope
