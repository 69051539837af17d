#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/layers.h"
#include "core/vec3.h"

namespace contactscope {

/// What a view is a picture of.
enum class ViewKind {
  Scene,         // shapes in space
  ContactPlane,  // one cell a pair: the reduction, seen along the normal
};

/// What a view reveals over a sequence.
enum class Story {
  None,       // every frame shows all of its layers
  ClipSteps,  // frame k shows the first k side planes and what they cut
  GjkSteps,   // frame k shows the simplex of GJK after step k
  EpaSteps,   // frame k shows the polytope of EPA after k expansions
};

/// What the automatic camera frames.
enum class Focus { Contact, Shapes };

/// One camera on a scenario, and what it shows.
struct View {
  std::string name = "main";
  ViewKind kind = ViewKind::Scene;
  /// Of a contact plane: how many choices of the reducer are shown, the last one with what each
  /// candidate was worth. 0: the result.
  int choices = 0;
  std::optional<Vec3d> eye;  // metres; default: fitted
  std::optional<Vec3d> target;
  std::optional<double> fov_degrees;
  std::optional<double> orthographic_height;  // metres
  /// Metres of an arrow for one newton second, where loads are shown for one newton; default:
  /// fitted.
  std::optional<double> impulse_scale;
  /// Over its pictures; see core/title.h. Default: the scenario's.
  std::optional<std::string> title;
  /// Each pair in a viewport of its own, all with the same parallel projection, side by side.
  bool side_by_side = false;
  /// A subject under 20 pixels is shown again, magnified.
  bool inset = true;
  Focus focus = Focus::Contact;
  Story story = Story::None;
  std::vector<Layer> layers;
  std::vector<Panel> panels;
  /// Of the panels plots and stability; default: all that the sequence has values for.
  std::optional<std::vector<Chart>> charts;

  bool shows(Layer layer) const { return std::ranges::find(layers, layer) != layers.end(); }
  bool shows(Panel panel) const { return std::ranges::find(panels, panel) != panels.end(); }
  bool shows(Chart chart) const {
    return !charts || std::ranges::find(*charts, chart) != charts->end();
  }
};

}  // namespace contactscope
