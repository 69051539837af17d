#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace contactscope {

/// Threads that do independent pieces of work together with the one that asks for it. They are started
/// once, some 20 to 50 microseconds each, and wait between two lists of work.
class Workers {
 public:
  /// `count`: of threads, the caller's among them; 1 or more.
  explicit Workers(int count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int count() const { return 1 + static_cast<int>(threads_.size()); }

  /// Calls work(i, worker) once for each i from 0 to `pieces` - 1 and returns when all calls have. `worker`,
  /// from 0 to count() - 1, is the thread's number: what it alone uses may be kept by it. Pieces are begun
  /// in order, whichever thread is free, so they must not depend on each other.
  ///
  /// After an exception no further piece is begun; that of the first piece that threw is thrown again.
  void for_each(int pieces, const std::function<void(int i, int worker)>& work);

 private:
  void run(int worker);
  void take_part(int worker);

  std::mutex mutex_;  // of all below
  std::condition_variable begun_, ended_;
  const std::function<void(int, int)>* work_ = nullptr;
  int pieces_ = 0, next_ = 0;
  int lists_ = 0;  // so many were begun
  int busy_ = 0;   // threads that take part
  bool stop_ = false;
  std::exception_ptr error_;
  int error_at_ = 0;
  std::vector<std::thread> threads_;
};

/// As many as the processor runs at once.
int hardware_threads();

}  // namespace contactscope
