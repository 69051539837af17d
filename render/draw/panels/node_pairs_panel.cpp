#include <algorithm>
#include <cstdint>

#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"

/// Simultaneous traversal of two trees of boxes: Gottschalk, Lin and Manocha 1996, "OBBTree",
/// section 5.
namespace contactscope::draw {
namespace {

constexpr double kMatrixCaption = 22;  // pixels at 720 lines, left of and below the matrix
constexpr double kMinMatrix = 150, kGoodMatrix = 300, kMaxMatrix = 316;
constexpr double kMinBlock = 2.6;  // smallest size of a pair of leaves

bool has_node_pairs(const trace::Pair& pair) {
  return pair.query && !pair.query->node_pairs.empty();
}

/// Matrix of all pairs of a triangle of A (rows) and one of B (columns), both in tree order. The
/// area of a skipped block is the work that it saves.
class NodePairsPanel : public PanelContent {
 public:
  using PanelContent::PanelContent;

  PanelNeed need(const PanelMoment&) const override {
    const auto high = [&](double matrix) {
      return Sheet::heading_height(scale_) + 4 * Sheet::line_height(scale_) +
             static_cast<float>(matrix + kMatrixCaption) * scale_;
    };
    return {high(kMinMatrix), high(kGoodMatrix), high(kMaxMatrix), 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("triangles of A against those of B");
    const trace::Pair* pair = first_pair(frames_[moment.frame], has_node_pairs);
    if (pair == nullptr) {
      sheet.paragraph("does not apply: no two meshes are asked in this frame", kQuietText);
      return {};
    }
    const std::vector<trace::NodePair>& visits = pair->query->node_pairs;
    const double all = static_cast<double>(visits[0].count_a) * visits[0].count_b;
    const double left_out = spared(visits);
    sheet.row("compared",
              spell_count(static_cast<std::int64_t>(visits.size())) + " pairs of boxes");
    sheet.row("spared", spell_number(100 * left_out / all) + " % of " +
                            spell_count(static_cast<std::int64_t>(all)) + " pairs, grey");
    sheet.row("a grey block", "two boxes that are apart");
    sheet.row("left to test", spell_count(static_cast<std::int64_t>(all - left_out)) +
                                  " pairs of triangles, green");
    draw_matrix(visits, sheet);
    return {};
  }

 private:
  /// Number of triangle pairs in skipped blocks.
  static double spared(const std::vector<trace::NodePair>& visits) {
    double sum = 0;
    for (const trace::NodePair& visit : visits)
      if (!visit.overlaps) sum += static_cast<double>(visit.count_a) * visit.count_b;
    return sum;
  }

  static void draw_matrix(const std::vector<trace::NodePair>& visits, const Sheet& sheet) {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double caption = pen.px(kMatrixCaption);
    const double side = std::min(rest.width - caption, rest.height - caption);
    if (side <= 0) return;
    const Rect matrix{rest.x + caption, rest.y, side, side};
    const double cell_a = side / visits[0].count_a, cell_b = side / visits[0].count_b;
    // A block of minimum size at the end is shifted, so that it ends with the matrix.
    const auto block = [&](const trace::NodePair& visit, double least) -> Rect {
      const double wide = std::max(least, cell_b * visit.count_b),
                   high = std::max(least, cell_a * visit.count_a);
      return {std::min(matrix.x + cell_b * visit.before_b, matrix.right() - wide),
              std::min(matrix.y + cell_a * visit.before_a, matrix.bottom() - high), wide, high};
    };
    for (const trace::NodePair& visit : visits) {
      if (visit.overlaps) continue;
      const Rect rect = block(visit, 0);
      pen.fill(rect, with_alpha(kDropped, 0.28f));
      if (std::min(rect.width, rect.height) > pen.px(4)) pen.frame(rect, 0.8, kWhite);
    }
    for (const trace::NodePair& visit : visits)
      if (visit.overlaps && visit.leaves) pen.fill(block(visit, pen.px(kMinBlock)), kClipPolygon);
    pen.frame(matrix, 1.2, kShapeEdge);
    // Labels are at the middle of each axis, on the side of its start.
    const double below = matrix.bottom() + 0.75 * caption;
    pen.text("triangles of B, in tree order", pixel(matrix.x + 0.5 * side, below), Align::Center,
             kQuietText);
    pen.text("A", pixel(rest.x, matrix.y + 0.5 * side), Align::Left, kArcOfA, Weight::Bold);
  }
};

}  // namespace

const PanelDrawing kNodePairsPanel{.needs = {&Stages::query, &Stages::node_pairs},
                                   .make = make_panel<NodePairsPanel>};

}  // namespace contactscope::draw
