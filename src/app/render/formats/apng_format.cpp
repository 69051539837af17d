#include "app/render/formats/format.h"
#include "image/apng.h"
#include "image/whole_file.h"

namespace contactscope::app {
namespace {

class ApngAnimation : public Animation {
 public:
  explicit ApngAnimation(const ReelPlan& plan) : path_(plan.path), origin_(plan.origin) {}

  void add(const Image& image, const Duration& shown) override {
    encoder_.add(image, shown.milliseconds);
  }
  void finish() override { write_whole_file(path_, encoder_.finish(entries_of(origin_))); }

 private:
  std::string path_;
  PictureOrigin origin_;
  ApngEncoder encoder_;
};

}  // namespace

const Format kApngFormat{
    .name = "apng",
    .extension = ".apng",
    .what = "an animated PNG, one file per sequence",
    .needs_pixels = true,
    .begin =
        [](const ReelPlan& plan) { return reel_of(plan, std::make_unique<ApngAnimation>(plan)); },
};

}  // namespace contactscope::app
