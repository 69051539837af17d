#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

/// The code of Gregorius 2015, "Overlap Test (3D)" and "Contact Creation", with the numbers that a
/// frame's record has for a pair. Branches after the one that is taken are grey.
namespace contactscope::draw {
namespace {

// Pixels at 720 lines: the band behind a line, and rows of values without room next to their code.
constexpr double kBandMargin = 5, kWrapped = 60;
constexpr double kLargestCode = 1.1;  // factor of all sizes if there is room
constexpr int kMaxLines = 9;

struct CodeLine {
  std::string code, value{};
  std::optional<Color> decides{};  // colour of the features that the line decided for
  bool is_skipped = false;         // a branch that is not taken
};

struct AxisQuery {
  std::string axis, name, call;
  std::optional<double> separation{};
  std::string features{};
};

bool has_code(const trace::Pair& pair) { return pair.sat || (pair.cache && pair.cache->hit); }

std::vector<CodeLine> code_of(const Staging& staging, const trace::Frame& frame,
                              const trace::Pair& pair) {
  if (!pair.sat) return {{"return the last frame's result", "it still holds", kAxis}};
  const trace::Sat& sat = *pair.sat;
  const double noise = noise_of(*staging.header, staging.meshes, frame, pair);
  const auto length = [&](double m) { return spell_length(m, noise, staging.scales.length); };
  const bool touches = !all_points(pair).empty();
  std::vector<AxisQuery> queries;
  if (const auto& face = sat.face_a)
    queries.push_back({"face_a", "faceA", "QueryFaceDirections(A, B)", face->separation,
                       "face " + std::to_string(face->face)});
  if (const auto& face = sat.face_b)
    queries.push_back({"face_b", "faceB", "QueryFaceDirections(B, A)", face->separation,
                       "face " + std::to_string(face->face)});
  if (sat.edge || touches) queries.push_back({"edge_edge", "edges", "QueryEdgeDirections(A, B)"});
  if (const auto& edge = sat.edge) {
    queries.back().separation = edge->separation;
    queries.back().features = "edges " + std::to_string(edge->a) + ", " + std::to_string(edge->b);
  }
  std::vector<CodeLine> lines;
  double best = -std::numeric_limits<double>::infinity();
  for (const AxisQuery& query : queries) {
    lines.push_back({query.name + " = " + query.call,
                     query.separation ? length(*query.separation) : "none is better"});
    best = std::max(best, query.separation.value_or(best));
    if (!touches && sat.chosen == query.axis && query.separation > 0.0)
      lines.push_back({"if (" + query.name + " > margin) return", "separated", kAxis});
  }
  if (!touches) return lines;
  lines.push_back({"best = max(faceA, faceB, edges)", length(best)});
  // The first axis within the tolerance of the best; B's faces before A's if they were preferred.
  const auto is_within = [&](const AxisQuery& query) {
    return sat.tolerance && query.separation && best - *query.separation <= *sat.tolerance;
  };
  if (sat.face_a && sat.chosen == "face_b" && is_within(queries[0]))
    std::swap(queries[0], queries[1]);
  bool is_decided = false;
  for (const AxisQuery& query : queries) {
    const bool is_chosen = sat.chosen == query.axis, is_edge = query.axis == "edge_edge";
    std::optional<Color> color;
    if (is_chosen) color = is_edge ? kAxis : kReferenceFace;
    if (!is_edge) {
      const std::string limit = sat.tolerance ? length(*sat.tolerance) : "not recorded";
      const char* const answer = is_chosen ? ": yes" : is_within(query) ? ": not so deep" : ": no";
      const std::string branch = &query == &queries.front() ? "if" : "else if";
      const std::string value = length(best - *query.separation) + " ≤ " + limit + answer;
      lines.push_back({branch + " (best − " + query.name + " ≤ tolerance)", is_decided ? "" : value,
                       color, is_decided});
    }
    lines.push_back({is_edge ? "else CreateEdgeContact()"
                             : std::string("    CreateFaceContact(") + query.name.back() + ")",
                     is_decided ? "" : query.features, color, !is_chosen});
    is_decided = is_decided || is_chosen;
  }
  return lines;
}

class CodePanel : public PanelContent {
 public:
  using PanelContent::PanelContent;

  PanelNeed need(const PanelMoment&) const override {
    return need_of(0, kWrapped, kWrapped, 0, kMaxLines);
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const trace::Frame& frame = frames_[moment.frame];
    const trace::Pair* const pair = first_pair(frame, has_code);
    sheet.heading(pair == nullptr ? "SAT(A, B)" : "SAT(" + pair->a + ", " + pair->b + ")");
    if (pair == nullptr) return sheet.inapplicable("no separating axis test is recorded");
    const std::vector<CodeLine> lines = code_of(staging_, frame, *pair);
    sheet.enlarge(kLargestCode);
    const Rect rest = sheet.rest();
    const Pen& pen = sheet.pen();
    // A value without room next to its code has a row of its own.
    std::vector<double> rows;
    for (const auto& [code, value, decides, is_skipped] : lines)
      rows.push_back(pen.width_of(code + "  " + value, Weight::Bold) > rest.width ? 2 : 1);
    const double all = std::accumulate(rows.begin(), rows.end(), 0.0) * sheet.line_height();
    sheet.enlarge(std::clamp(kLargestCode * rest.height / all, 1.0, kLargestCode));
    double y = rest.y;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& [code, value, decides, is_skipped] = lines[i];
      const double row = sheet.line_height(), margin = pen.px(kBandMargin);
      const Rect band{rest.x - margin, y, rest.width + 2 * margin, rows[i] * row};
      if (decides) pen.fill(band, with_alpha(*decides, 0.25f));
      const Weight weight = decides ? Weight::Bold : Weight::Regular;
      const Color& color = is_skipped ? kQuietText : kText;
      pen.text(code, pixel(rest.x, y + 0.78 * row), Align::Left, color, weight);
      y = band.bottom();
      pen.text(value, pixel(rest.right(), y - 0.22 * row), Align::Right, color, weight);
    }
    return {};
  }
};

}  // namespace

const PanelDrawing kCodePanel{.needs = {&Stages::sat}, .make = make_panel<CodePanel>};

}  // namespace contactscope::draw
