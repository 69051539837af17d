#include "app/cli/verbs.h"
#include "app/render/formats/format.h"
#include "snapshot/store.h"
#include "viewer/viewer.h"

namespace contactscope::app {
namespace {

class ViewerReel : public Reel {
 public:
  explicit ViewerReel(const ReelPlan& plan)
      : path_(plan.path), viewer_(*plan.staging, plan.origin, plan.sequence->ids_are_made) {}

  void add(const Shot&, const trace::Frame& frame) override { viewer_.add(frame); }
  void finish() override { snapshot::write_text(path_, viewer_.html()); }

 private:
  std::string path_;
  viewer::Viewer viewer_;
};

}  // namespace

const Format kViewerFormat{
    .name = "viewer",
    .extension = ".viewer.html",
    .what = "a page in 3D with a timeline, facts and search, one file per sequence",
    .needs_drawings = false,
    .begin = [](const ReelPlan& plan) -> std::unique_ptr<Reel> {
      return std::make_unique<ViewerReel>(plan);
    },
    .require =
        [] {
          if (viewer::three_script().empty())
            throw UsageError(
                "--format viewer: the program was built without three.js; install it "
                "(apt-get install libjs-three) and build again");
        },
};

}  // namespace contactscope::app
