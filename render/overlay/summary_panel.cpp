#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "overlay/paint.h"
#include "overlay/panels.h"

namespace contactscope::overlay {
namespace {

// Of two hulls that touch.
constexpr std::size_t kUsualRows = 5;

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string spoken(const std::string& axis) {
  if (axis == "face_a") return "face of A";
  if (axis == "face_b") return "face of B";
  if (axis == "edge_edge") return "edge of A, edge of B";
  return axis;
}

// "point-face", or of a mesh's many manifolds each type once.
std::string types_of(const trace::Pair& pair) {
  std::vector<std::string> types;
  for (const trace::Manifold& manifold : pair.manifolds) {
    if (std::ranges::find(types, manifold.type) == types.end()) types.push_back(manifold.type);
  }
  std::string text;
  for (const std::string& type : types) text += (text.empty() ? "" : ", ") + type;
  return text;
}

std::string answered(const std::string& answer) {
  return answer == "skip" ? "no contact made" : "fallback";
}

std::string counted(const trace::Pair& pair) {
  std::size_t kept = 0;
  for (const trace::Manifold& manifold : pair.manifolds) kept += manifold.points.size();
  std::string text = std::to_string(kept);
  if (pair.manifolds.size() > 1) {
    return text + " in " + std::to_string(pair.manifolds.size()) + " manifolds";
  }
  if (pair.reduction && pair.reduction->points.size() > kept) {
    text +=
        " of " + std::to_string(pair.reduction->points.size()) + ", by " + pair.reduction->method;
  }
  return text;
}

Rows rows_of(const trace::Pair& pair) {
  Rows rows;
  rows.emplace_back("pair", pair.kind);
  rows.emplace_back("state", pair.state);
  if (pair.sat) rows.emplace_back("axis", spoken(pair.sat->chosen));
  if (!pair.manifolds.empty()) rows.emplace_back("contact", types_of(pair));
  rows.emplace_back(pair.separation > 0 ? "gap" : "separation",
                    draw::spell_length(pair.separation));
  if (pair.state != "separated") rows.emplace_back("points", counted(pair));
  if (pair.incremental) {
    const trace::Incremental& incremental = *pair.incremental;
    rows.emplace_back(
        "cores", incremental.query == "gjk" ? "apart, by gjk" : "overlap, by " + incremental.query);
    rows.emplace_back("confirmed", "by " + incremental.confirm);
  }
  if (pair.degenerate) {
    rows.emplace_back("no normal",
                      pair.degenerate->geometry + "; " + answered(pair.degenerate->answer));
  }
  return rows;
}

Rows time_rows(const PanelFacts& facts) {
  const trace::Frame& frame = facts.frames[facts.current];
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.3f s", frame.time);
  Rows rows{{"time", text.data()}};
  if (facts.pipeline_nanoseconds) {
    std::snprintf(text.data(), text.size(), "%.2f µs", *facts.pipeline_nanoseconds / 1000);
    rows.emplace_back("pipeline", text.data());
  }
  return rows;
}

// A degenerate geometry's name takes a second line.
std::size_t lines_of(const trace::Pair& pair) {
  return rows_of(pair).size() + (pair.degenerate ? 1 : 0);
}

std::string title_of(const trace::Pair& pair) {
  const std::string names = pair.a + ", " + pair.b;
  return pair.label.empty() ? names : pair.label + ": " + names;
}

void show(const Rows& rows, float scale) {
  for (const auto& [name, value] : rows) {
    ImGui::TextColored(ImColor(packed(draw::kQuietText)), "%s", name.c_str());
    ImGui::SameLine(96 * scale);
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopTextWrapPos();
  }
}

// The rows of a touching pair, so that panels below keep their place when a pair comes apart; and of
// the frame of the sequence that has most to say.
float pair_height(const PanelFacts& facts) {
  std::size_t rows = kUsualRows;
  for (const trace::Frame& other : facts.frames) {
    for (const trace::Pair& pair : other.pairs) rows = std::max(rows, lines_of(pair));
  }
  return (2.2f + static_cast<float>(rows)) * ImGui::GetTextLineHeightWithSpacing();
}

float summary_height(const PanelFacts& facts, std::size_t pairs) {
  const std::size_t all = facts.frames[facts.current].pairs.size();
  const std::size_t lines = time_rows(facts).size() + (pairs < all ? 1 : 0);
  return pair_height(facts) * static_cast<float>(pairs) +
         ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(lines);
}

}  // namespace

PanelNeed summary_need(const PanelFacts& facts) {
  const std::size_t all = facts.frames[facts.current].pairs.size();
  const float least = panel_frame() + summary_height(facts, std::min<std::size_t>(1, all));
  return {least, least, panel_frame() + summary_height(facts, all), 0};
}

// The first pairs, as many as have room whole, so that the same ones are there in every frame.
std::string summary_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const std::vector<trace::Pair>& pairs = facts.frames[facts.current].pairs;
  std::size_t shown = pairs.size();
  constexpr float kRounding = 0.5f;  // pixels; heights were added in another order
  while (shown > 1 && summary_height(facts, shown) > height + kRounding) --shown;
  for (std::size_t i = 0; i < shown; ++i) {
    heading(title_of(pairs[i]).c_str(), scale);
    show(rows_of(pairs[i]), scale);
    ImGui::Dummy({0, 0.4f * ImGui::GetTextLineHeight()});
  }
  std::string missing = more(pairs.size() - shown, "pair", "pairs");
  show(time_rows(facts), scale);
  return missing;
}

}  // namespace contactscope::overlay
