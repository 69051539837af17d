#pragma once

#include <algorithm>
#include <map>
#include <memory>

namespace contactscope {

/// States of something that only steps forward, so that any frame can be had without all before it
/// again: the last two that were put in, and of the others every so many, as many as there is room
/// for. `State` has an `int frame`. Not safe on several threads by itself.
template <class State>
class Snapshots {
 public:
  /// At most `limit` besides the last two.
  explicit Snapshots(std::size_t limit = 2) : limit_(std::max<std::size_t>(limit, 1)) {}

  /// The latest one not after `frame`; nullptr where there is none.
  std::shared_ptr<const State> before(int frame) const {
    const auto later = states_.upper_bound(frame);
    return later == states_.begin() ? nullptr : std::prev(later)->second;
  }

  void put(std::shared_ptr<const State> state) {
    const int frame = state->frame;
    if (frame != last_) {
      before_last_ = last_;
      last_ = frame;
    }
    states_.insert_or_assign(frame, std::move(state));
    thin();
    while (states_.size() > limit_ + 2) {
      stride_ *= 2;
      thin();
    }
  }

  std::size_t size() const { return states_.size(); }

 private:
  void thin() {
    std::erase_if(states_, [this](const auto& entry) {
      return entry.first % stride_ != 0 && entry.first != last_ && entry.first != before_last_;
    });
  }

  std::size_t limit_;
  int stride_ = 1;
  int last_ = -1, before_last_ = -1;
  std::map<int, std::shared_ptr<const State>> states_;
};

}  // namespace contactscope
