#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "core/standard.h"

namespace contactscope {

/// Thread pool that includes the calling thread. Threads start once, in 20 to 50 microseconds each.
class Workers {
 public:
  /// `count`: number of threads, including the caller's; 1 or more.
  explicit Workers(int count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  int count() const { return 1 + static_cast<int>(threads_.size()); }

  /// Calls work(i, worker) once for each i from 0 to `pieces` - 1 and returns when all calls have.
  /// `worker`, from 0 to count() - 1, is the thread's number, for data per thread. Pieces begin in
  /// order on whichever thread is free, so they must not depend on each other.
  ///
  /// After an exception no further piece begins; the exception of the lowest piece is rethrown.
  void for_each(int pieces, const std::function<void(int i, int worker)>& work);

 private:
  void run(int worker);
  void take_part(int worker);

  std::mutex mutex_;  // guards all members below
  std::condition_variable begun_, ended_;
  const std::function<void(int, int)>* work_ = nullptr;
  int pieces_ = 0, next_ = 0;
  int lists_ = 0;  // number of lists begun
  int busy_ = 0;   // threads at work
  bool stop_ = false;
  std::exception_ptr error_;
  int error_at_ = 0;
  std::vector<std::thread> threads_;
};

int hardware_threads();

}  // namespace contactscope
