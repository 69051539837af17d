#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "draw/charts/axis_history.h"
#include "draw/scene/palette.h"
#include "overlay/paint.h"
#include "overlay/panels.h"

namespace contactscope::overlay {
namespace {

struct Row {
  const char* axis;
  const char* name;
};
constexpr std::array<Row, 3> kRows{
    {{"face_a", "face A"}, {"face_b", "face B"}, {"edge_edge", "edges"}}};

// Lines of text.
constexpr float kMostRow = 1.8f;
constexpr float kLeastRow = 0.9f;
constexpr float kAroundRows = 1.6f;  // a title and space below

constexpr float least_history() {
  return kAroundRows + kLeastRow * static_cast<float>(kRows.size());
}

bool from_cache(const trace::Pair& pair) {
  return pair.cache && pair.cache->hit;
}

/// The pair `wanted` of the current frame in frame f; nullptr where that has none. Traces of other
/// engines may leave out pairs that are far apart; mostly each frame has all in the same order.
const trace::Pair* pair_then(const PanelFacts& facts, std::size_t f, const trace::Pair& wanted) {
  const auto same = [&](const trace::Pair& pair) {
    return pair.a == wanted.a && pair.b == wanted.b && pair.label == wanted.label;
  };
  const std::vector<trace::Pair>& pairs = facts.frames[f].pairs;
  const auto usual = static_cast<std::size_t>(&wanted - facts.frames[facts.current].pairs.data());
  if (usual < pairs.size() && same(pairs[usual])) return &pairs[usual];
  const auto found = std::ranges::find_if(pairs, same);
  return found == pairs.end() ? nullptr : &*found;
}

/// The pairs of this frame of which an axis is known in some frame.
std::vector<const trace::Pair*> pairs_with_axes(const PanelFacts& facts) {
  std::vector<const trace::Pair*> pairs;
  for (const trace::Pair& pair : facts.frames[facts.current].pairs) {
    for (std::size_t f = 0; f < facts.frames.size(); ++f) {
      const trace::Pair* const then = pair_then(facts, f, pair);
      if (then == nullptr || draw::axis_of(*then).empty()) continue;
      pairs.push_back(&pair);
      break;
    }
  }
  return pairs;
}

bool cache_is_told(const PanelFacts& facts) {
  return std::ranges::any_of(facts.frames, [](const trace::Frame& frame) {
    return std::ranges::any_of(frame.pairs, from_cache);
  });
}

/// The frames up to now.
std::vector<draw::AxisMoment> history_of(const PanelFacts& facts, const trace::Pair& pair) {
  std::vector<const trace::Pair*> pairs;
  for (std::size_t f = 0; f <= facts.current; ++f) pairs.push_back(pair_then(facts, f, pair));
  return draw::axis_history(pairs);
}

/// What the frames up to now come to.
struct Counts {
  int switches = 0;
  int hits = 0;
  int tests = 0;
};

Counts count(const std::vector<draw::AxisMoment>& history) {
  Counts counts;
  for (const draw::AxisMoment& moment : history) {
    if (moment.pair == nullptr) continue;
    counts.switches += moment.switched;
    ++(from_cache(*moment.pair) ? counts.hits : counts.tests);
  }
  return counts;
}

std::string counted(int number, const char* one, const char* many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

/// "2 switches", and where a cache is at work how often the full test ran.
std::string spoken(const Counts& counts) {
  std::string text = counted(counts.switches, "switch", "switches");
  if (counts.hits > 0)
    text += ", " + counted(counts.tests, "full test", "full tests") + ", " +
            counted(counts.hits, "cache hit", "cache hits");
  return text;
}

}  // namespace

PanelNeed axis_history_need(const PanelFacts& facts) {
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const std::size_t pairs = std::max<std::size_t>(1, pairs_with_axes(facts).size());
  const float frame = panel_frame() + heading_height(facts.staging.layout.scale) +
                      (cache_is_told(facts) ? line : 0);
  const float each = least_history() * line;
  return {frame + each + (pairs > 1 ? line : 0), frame + each * static_cast<float>(pairs), 0, 1};
}

// Which axis made the contact, frame by frame: a switch of rows is a flip-flop, and so is a gap in a
// row, where another face or another pair of edges took over. Frames that went by the cache are half
// as high: no axis was looked for in them.
std::string axis_history_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const float top = ImGui::GetCursorPosY();
  heading("chosen axis, frame by frame", scale);
  const std::vector<const trace::Pair*> pairs = pairs_with_axes(facts);
  if (pairs.empty()) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(ImColor(packed(draw::kQuietText)),
                       "does not apply: no separating axis test of two hulls in this sequence");
    ImGui::PopTextWrapPos();
    return {};
  }
  if (cache_is_told(facts)) ImGui::TextUnformatted("half as high: from the cache, untested");
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float width = ImGui::GetContentRegionAvail().x;
  const float left = 62 * scale;
  const float cell = (width - left) / static_cast<float>(facts.frames.size());
  float available = height - (ImGui::GetCursorPosY() - top);
  std::size_t shown = pairs.size();
  if (least_history() * line * static_cast<float>(shown) > available) {
    available -= line;  // for the words below
    shown = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::max(0.0f, available / (least_history() * line))));
  }
  const float row =
      std::min(kMostRow * line, (available / static_cast<float>(shown) - kAroundRows * line) /
                                    static_cast<float>(kRows.size()));
  ImDrawList* list = ImGui::GetWindowDrawList();

  for (std::size_t p = 0; p < shown; ++p) {
    const trace::Pair& pair = *pairs[p];
    const std::vector<draw::AxisMoment> history = history_of(facts, pair);
    const std::string title =
        (pair.label.empty() ? pair.a + ", " + pair.b : pair.label) + ": " + spoken(count(history));
    ImGui::TextUnformatted(title.c_str());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    for (std::size_t r = 0; r < kRows.size(); ++r) {
      const float y = corner.y + row * static_cast<float>(r);
      list->AddText({corner.x, y + 0.5f * (row - ImGui::GetTextLineHeight())},
                    packed(draw::kQuietText), kRows[r].name);
      list->AddRectFilled({corner.x + left, y + scale}, {corner.x + width, y + row - scale},
                          packed(draw::with_alpha(draw::kQuietText, 0.10f)));
      for (std::size_t f = 0; f <= facts.current; ++f) {
        const trace::Pair* const then = history[f].pair;
        if (then == nullptr || history[f].axis != kRows[r].axis) continue;
        const float x = corner.x + left + cell * static_cast<float>(f);
        const bool is_now = f == facts.current;
        const float top_of_bar = from_cache(*then) ? y + 0.5f * row : y + scale;
        list->AddRectFilled({x, top_of_bar}, {x + cell + 0.5f, y + row - scale},
                            packed(is_now ? draw::kAxisText : draw::kAxis));
        if (history[f].switched) {
          list->AddRectFilled({x - 1.5f * scale, y}, {x + 1.5f * scale, y + row},
                              packed(draw::kWhite));
        }
      }
    }
    ImGui::Dummy({width, row * static_cast<float>(kRows.size()) + 0.5f * line});
  }
  return more(pairs.size() - shown, "pair", "pairs");
}

}  // namespace contactscope::overlay
