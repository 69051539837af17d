#include "app/cli/verbs.h"
#include "app/render/formats/rows.h"
#include "image/whole_file.h"
#include "page/page.h"
#include "vector/font_subset.h"

namespace contactscope::app {
namespace {

class HtmlReel : public Reel {
 public:
  explicit HtmlReel(const ReelPlan& plan) : path_(plan.path), page_(*plan.staging, plan.origin) {}

  void add(const Shot& shot, const trace::Frame& frame) override {
    page_.add(frame, *shot.drawing);
  }
  void finish() override {
    const std::string html = page_.html();
    write_whole_file(path_, std::vector<std::uint8_t>(html.begin(), html.end()));
  }

 private:
  std::string path_;
  page::Page page_;
};

}  // namespace

const Format kHtmlFormat{
    .name = "html",
    .extension = ".html",
    .what = "a page with a slider and the trace's facts, one file per sequence",
    .begin = [](const ReelPlan& plan) -> std::unique_ptr<Reel> {
      return std::make_unique<HtmlReel>(plan);
    },
    .require =
        [] {
          try {
            vector::font_subset(FontWeight::Regular, {U'a'});
          } catch (const vector::MissingLibrary& error) {
            throw UsageError(std::string("--format html: ") + error.what());
          }
        },
};

}  // namespace contactscope::app
