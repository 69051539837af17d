#include "snapshot/flipped.h"

#include <algorithm>
#include <cmath>

#include "snapshot/spelling.h"

namespace contactscope::snapshot {
namespace {

/// Two axes tie if their separations differ by less than this fraction of the larger one.
constexpr double kTie = 0.01;

const trace::Decision* find_decision(const std::vector<trace::Decision>& margins,
                                     const std::string& stage) {
  const auto found = std::ranges::find(margins, stage, &trace::Decision::stage);
  return found == margins.end() ? nullptr : &*found;
}

/// A margin as text: "3 um", "0.2 mm^2", "1e-06 of a cosine".
std::string spell_margin(const trace::Decision& decision) {
  if (decision.margin) return spell_length(std::max(*decision.margin, 0.0));
  if (decision.margin_area)
    return printed("%.*g mm^2", 2, std::max(*decision.margin_area, 0.0) * 1e6);
  return printed("%.*g of a cosine", 2, std::max(decision.margin_cosine.value_or(0), 0.0));
}

/// ", with 3 um to spare": the margin of the decision.
std::string to_spare(const trace::Decision* decision) {
  return decision == nullptr ? "" : ", with " + spell_margin(*decision) + " to spare";
}

/// "face_a" as text.
std::string spell_axis(const std::string& axis) {
  if (axis == "face_a") return "face a";
  if (axis == "face_b") return "face b";
  return axis == "edge_edge" ? "an edge pair" : axis.empty() ? "none" : axis;
}

std::optional<double> separation_along(const trace::Sat& sat, const std::string& axis) {
  if (axis == "face_a" && sat.face_a) return sat.face_a->separation;
  if (axis == "face_b" && sat.face_b) return sat.face_b->separation;
  if (axis == "edge_edge" && sat.edge) return sat.edge->separation;
  return {};
}

/// The test chose another axis: both with their separations and the difference. A preference may
/// overrule the larger separation; its margin is added if it is a different number.
std::string spell_chosen(const trace::Sat& before, const trace::Sat& now,
                         const trace::Decision* margin) {
  std::string text = "the separating axis test now prefers " + spell_axis(now.chosen);
  const auto taken = separation_along(now, now.chosen), left = separation_along(now, before.chosen);
  if (!taken || !left) return text + " to " + spell_axis(before.chosen) + to_spare(margin);
  const double between = std::abs(*taken - *left);
  const auto [a, b] = spell_both(*taken * 1e3, *left * 1e3);
  if (between > 0)
    text += ": " + a + " mm against " + b + " mm of " + spell_axis(before.chosen);
  else
    text +=
        " to " + spell_axis(before.chosen) + ": " + printed("%.*g mm", 4, *taken * 1e3) + " both";
  const bool is_tie = between <= kTie * std::max(std::abs(*taken), std::abs(*left));
  // In mm as the separations, unless that needs many digits.
  const std::string spelled =
      between >= 1e-5 && between < 1 ? printed("%.*g mm", 2, between * 1e3) : spell_length(between);
  if (is_tie)
    text += between > 0 ? ", a tie of " + spelled : ", a tie";
  else
    text += ", " + spelled + " between them";
  constexpr double kSameNumber = 0.05;
  const bool says_more =
      margin && margin->margin && std::abs(*margin->margin - between) > kSameNumber * between;
  if (!says_more) return text;
  const bool is_of_another = margin->over != before.chosen;
  return text + to_spare(margin) + (is_of_another ? " over " + spell_axis(margin->over) : "");
}

std::string face(int number) { return "face " + std::to_string(number); }

/// Points of a reduction, in canonical order.
std::vector<int> sorted(std::vector<int> points) {
  std::ranges::sort(points);
  return points;
}

std::optional<Flipped> find_flipped_points(const trace::Reduction& before,
                                           const trace::Reduction& now,
                                           const std::vector<trace::Decision>& margins) {
  // If the points differ, their indices cannot be compared.
  if (before.points.size() != now.points.size() || before.method != now.method ||
      sorted(before.kept) == sorted(now.kept))
    return {};
  const trace::Decision* margin = find_decision(margins, "points");
  for (std::size_t i = 0; i < std::min(before.kept.size(), now.kept.size()) && !margin; ++i)
    if (before.kept[i] != now.kept[i]) {
      margin = find_decision(margins, "point " + std::to_string(i));
      break;
    }
  return Flipped{Stage::Reduction, "",
                 "the reduction now keeps points " + spell_list(now.kept) + " instead of " +
                     spell_list(before.kept) + to_spare(margin)};
}

}  // namespace

bool Flipped::says(const Difference& difference) const {
  if (difference.stage != stage) return false;
  return stage != Stage::Faces || difference.text.starts_with("incident");
}

std::optional<Flipped> find_flipped(const trace::Pair& before, const trace::Pair& now,
                                    const std::vector<trace::Decision>& margins) {
  if (before.state != now.state)
    return Flipped{Stage::Axes, "",
                   "the shapes are now " + now.state + " instead of " + before.state +
                       to_spare(find_decision(margins, "contact"))};
  if (before.sat && now.sat) {
    if (before.sat->chosen != now.sat->chosen)
      return Flipped{Stage::Decision, "",
                     spell_chosen(*before.sat, *now.sat, find_decision(margins, "axis"))};
    const std::string& chosen = now.sat->chosen;
    for (const auto& [name, axis] :
         {std::pair("face_a", &trace::Sat::face_a), std::pair("face_b", &trace::Sat::face_b)}) {
      const auto& old_face = *before.sat.*axis;
      const auto& new_face = *now.sat.*axis;
      if (chosen != name || !old_face || !new_face || old_face->face == new_face->face) continue;
      return Flipped{Stage::Axes, "",
                     "the best " + spell_axis(name) + " is now " + face(new_face->face) +
                         " instead of " + face(old_face->face) +
                         to_spare(find_decision(margins, name))};
    }
  }
  if (before.clip && now.clip && before.clip->reference.shape == now.clip->reference.shape &&
      before.clip->incident.face != now.clip->incident.face)
    return Flipped{Stage::Faces, "",
                   "the incident face is now " + face(now.clip->incident.face) + " instead of " +
                       face(before.clip->incident.face) +
                       to_spare(find_decision(margins, "incident_face"))};
  if (before.reduction && now.reduction)
    return find_flipped_points(*before.reduction, *now.reduction, margins);
  return {};
}

}  // namespace contactscope::snapshot
