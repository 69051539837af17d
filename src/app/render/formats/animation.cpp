#include "app/render/formats/format.h"

#include <cmath>
#include <future>
#include <utility>

namespace contactscope::app {
namespace {

/// For frames whose times do not increase.
constexpr double kNoTime = 1.0 / 25;

class AnimationReel : public Reel {
 public:
  AnimationReel(std::optional<double> fps, std::unique_ptr<Animation> animation)
      : fps_(fps), animation_(std::move(animation)) {}

  void add(const Shot& shot, const trace::Frame& frame) override {
    if (held_) show(frame.time - time_);
    held_ = shot.image;
    time_ = frame.time;
  }

  void finish() override {
    if (held_) show(last_);
    wait();
    animation_->finish();
  }

 private:
  /// Adds the held picture for a number of seconds of frame time.
  void show(double seconds) {
    last_ = seconds > 0 ? seconds : kNoTime;
    const double shown = fps_ ? 1 / *fps_ : last_;
    const auto milliseconds = [](double time) { return std::lround(1000 * time); };
    const Duration duration{shown,
                            static_cast<int>(milliseconds(begin_ + shown) - milliseconds(begin_))};
    begin_ += shown;
    wait();
    running_ = std::async(std::launch::async, [this, image = std::move(held_), duration] {
      animation_->add(*image, duration);
    });
    held_.reset();
  }

  void wait() {
    if (running_.valid()) running_.get();
  }

  std::optional<double> fps_;
  std::unique_ptr<Animation> animation_;
  std::shared_ptr<const Image> held_{};
  double time_ = 0, last_ = kNoTime, begin_ = 0;  // seconds
  std::future<void> running_{};                   // declared last: its destructor waits
};

}  // namespace

std::unique_ptr<Reel> reel_of(const ReelPlan& plan, std::unique_ptr<Animation> animation) {
  return std::make_unique<AnimationReel>(plan.fps, std::move(animation));
}

}  // namespace contactscope::app
