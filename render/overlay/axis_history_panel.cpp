#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "draw/palette.h"
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

bool from_cache(const trace::Pair& pair) {
  return pair.cache && pair.cache->hit;
}

/// Empty where nothing says.
std::string axis_of(const trace::Pair& pair) {
  if (pair.sat) return pair.sat->chosen;
  return from_cache(pair) ? pair.cache->axis : std::string();
}

/// What the frames up to now come to.
struct Counts {
  int switches = 0;
  int hits = 0;
  int tests = 0;
};

Counts count(const PanelFacts& facts, std::size_t pair) {
  Counts counts;
  std::string last;
  for (std::size_t f = 0; f <= facts.current; ++f) {
    const trace::Pair& then = facts.frames[f].pairs[pair];
    const std::string axis = axis_of(then);
    if (axis.empty()) continue;
    if (!last.empty() && axis != last) ++counts.switches;
    last = axis;
    ++(from_cache(then) ? counts.hits : counts.tests);
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

// Which axis made the contact, frame by frame: a switch of rows is a flip-flop. Frames that went by
// the cache are half as high: no axis was looked for in them.
void axis_history_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const trace::Frame& now = facts.frames[facts.current];
  const float top = ImGui::GetCursorPosY();
  heading("chosen axis, frame by frame", scale);
  if (std::ranges::any_of(facts.frames, [](const trace::Frame& frame) {
        return std::ranges::any_of(frame.pairs, from_cache);
      })) {
    ImGui::TextUnformatted("half as high: from the cache, untested");
  }
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float width = ImGui::GetContentRegionAvail().x;
  const float left = 62 * scale;
  const float cell = (width - left) / static_cast<float>(facts.frames.size());
  const float available = height - (ImGui::GetCursorPosY() - top);
  const float row =
      std::min(1.8f * line, (available / static_cast<float>(now.pairs.size()) - 1.6f * line) /
                                static_cast<float>(kRows.size()));
  ImDrawList* list = ImGui::GetWindowDrawList();

  for (std::size_t p = 0; p < now.pairs.size(); ++p) {
    const trace::Pair& pair = now.pairs[p];
    const std::string title =
        (pair.label.empty() ? pair.a + ", " + pair.b : pair.label) + ": " + spoken(count(facts, p));
    ImGui::TextUnformatted(title.c_str());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    for (std::size_t r = 0; r < kRows.size(); ++r) {
      const float y = corner.y + row * static_cast<float>(r);
      list->AddText({corner.x, y + 0.5f * (row - ImGui::GetTextLineHeight())},
                    packed(draw::kQuietText), kRows[r].name);
      list->AddRectFilled({corner.x + left, y + scale}, {corner.x + width, y + row - scale},
                          packed(draw::with_alpha(draw::kQuietText, 0.10f)));
      for (std::size_t f = 0; f <= facts.current; ++f) {
        const trace::Pair& then = facts.frames[f].pairs[p];
        if (axis_of(then) != kRows[r].axis) continue;
        const float x = corner.x + left + cell * static_cast<float>(f);
        const bool is_now = f == facts.current;
        const float top_of_bar = from_cache(then) ? y + 0.5f * row : y + scale;
        list->AddRectFilled({x, top_of_bar}, {x + cell + 0.5f, y + row - scale},
                            packed(is_now ? draw::kAxisText : draw::kAxis));
      }
    }
    ImGui::Dummy({width, row * static_cast<float>(kRows.size()) + 0.5f * line});
  }
}

}  // namespace contactscope::overlay
