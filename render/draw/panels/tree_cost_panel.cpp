#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

/// Cost of queries in a refitted tree, and the effect of a rebuild.
namespace contactscope::draw {
namespace {

constexpr double kMinChart = 70, kMaxChart = 400, kAxisBelow = 20,
                 kNames = 20;  // px at 720 lines
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// One curve per name, in order of first appearance; NaN in frames without a value.
class NamedCurves {
 public:
  explicit NamedCurves(std::size_t frames) : frames_(frames) {}

  void set(const std::string& name, std::size_t frame, double value) {
    const auto [place, is_new] = places_.try_emplace(name, names.size());
    if (is_new) {
      names.push_back(name);
      curves.emplace_back(frames_, kNone);
    }
    curves[place->second][frame] = value;
  }

  std::vector<std::string> names;
  std::vector<std::vector<double>> curves;

 private:
  std::size_t frames_;
  std::map<std::string, std::size_t> places_;
};

/// Number of node pairs compared for each pair of meshes. Without such queries, the number of boxes
/// that a small query is expected to test in the tree of each deforming mesh, from the surface
/// areas of its boxes. A rebuild shows as a sawtooth.
class TreeCostPanel : public PanelContent {
 public:
  using PanelContent::PanelContent;

  PanelNeed need(const PanelMoment&) const override {
    return need_of(kMinChart, 1.3 * kMinChart, kMaxChart, kNames + kAxisBelow);
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    if (names_.empty()) gather();
    sheet.heading("what the trees cost");
    const Pen pen(sheet.pen().drawing(), sheet.pen().scale(), kChartText);
    const Rect rect = sheet.rest();
    double x = rect.x, y = rect.y;
    const bool is_named = names_.size() > 1;
    for (std::size_t i = 0; i < names_.size() && is_named; ++i) {
      draw_series_swatch(i, pixel(x, y + pen.px(0.5 * kNames)), 18, pen);
      pen.text(names_[i], pixel(x + pen.px(22), y + pen.px(0.75 * kNames)), Align::Left, kText);
      x += pen.px(34) + pen.width_of(names_[i]);
    }
    y += is_named ? pen.px(kNames) : 0;
    const double height =
        std::min<double>(pen.px(kMaxChart), rect.height - pen.px(kAxisBelow) - pen.px(kNames));
    draw_series_chart(chart_, moment.frame, {rect.x, y, rect.width, height}, pen);
    const double gutter = pen.px(kChartGutter);
    draw_time_axis(frames_, rect.x + gutter, rect.width - gutter,
                   y + height + pen.px(kAxisBelow - 4), pen);
    return {};
  }

 private:
  /// Label of the pair with this mesh, or the mesh's name.
  static std::string name_of(const trace::Deformed& deformed,
                             const std::vector<trace::Pair>& pairs) {
    for (const trace::Pair& pair : pairs)
      if (!pair.label.empty() && (pair.a == deformed.name || pair.b == deformed.name))
        return pair.label;
    return deformed.name;
  }

  /// A pair gets the name of its deforming mesh, because the picture is about that mesh's tree.
  static std::string name_of(const trace::Pair& pair,
                             const std::vector<trace::Deformed>& deformed) {
    if (!pair.label.empty()) return pair.label;
    for (const trace::Deformed& mesh : deformed)
      if (mesh.name == pair.a || mesh.name == pair.b) return mesh.name;
    return pair_name(pair);
  }

  void gather() {
    NamedCurves expected(frames_.size()), compared(frames_.size());
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      for (const trace::Deformed& deformed : frames_[f].deformed)
        expected.set(name_of(deformed, frames_[f].pairs), f, deformed.cost);
      for (const trace::Pair& pair : frames_[f].pairs)
        if (pair.query && pair.query->trees)
          compared.set(name_of(pair, frames_[f].deformed), f, pair.query->trees->node_pairs);
    }
    const bool requested = !compared.names.empty();
    const NamedCurves& shown = requested ? compared : expected;
    chart_ = {requested ? "pairs of boxes compared" : "boxes a query is expected to test", ""};
    chart_.curves = shown.curves;
    chart_.fit();
    names_ = shown.names;
  }

  SeriesChart chart_;
  std::vector<std::string> names_;
};

// Simultaneous traversal of two trees of boxes: Gottschalk, Lin and Manocha 1996, "OBBTree",
// section 5.

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
    return need_of(kMinMatrix, kGoodMatrix, kMaxMatrix, kMatrixCaption, 4);
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("triangles of A against those of B");
    const trace::Pair* pair = first_pair(frames_[moment.frame], has_node_pairs);
    if (pair == nullptr) return sheet.inapplicable("no two meshes are asked in this frame");
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

const PanelDrawing kTreeCostPanel{.needs = {&Stages::query}, .make = make_panel<TreeCostPanel>};

const PanelDrawing kNodePairsPanel{.needs = {&Stages::query, &Stages::node_pairs},
                                   .make = make_panel<NodePairsPanel>};

}  // namespace contactscope::draw
