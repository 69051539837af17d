#pragma once

#include "core/vec3.h"
#include "view/layers.h"

namespace contactscope {

enum class ViewKind {
  Scene,         // shapes in space
  ContactPlane,  // one cell per pair: the reduction, seen along the normal
};

/// Feature that a view reveals step by step over a sequence.
enum class Story {
  None,       // every frame shows all of its layers
  ClipSteps,  // frame k shows the first k side planes and what they cut
  GjkSteps,   // frame k shows the simplex of GJK after step k
  EpaSteps,   // frame k shows the polytope of EPA after k expansions
  WalkSteps,  // frame k shows the k-th pair of features that V-Clip compares
};

/// Pictures within a view's picture.
enum class ViewLayout {
  One,
  SideBySide,  // each pair in its own viewport, all in the same parallel projection
  Stages,      // each layer but the shapes in its own viewport, all with the same camera
};

/// Target of the automatic camera.
enum class Focus {
  Contact,
  Shapes,
  Deepest,  // the pair with the largest overlap
  Worst,  // the pair that lint names first, else that with the largest overlap for its smaller body
};
inline constexpr std::array kFocusNames = {std::string_view("contact"), std::string_view("shapes"),
                                           std::string_view("deepest"), std::string_view("worst")};

/// A finding of `lint`, or where the condition of `--where` holds.
struct Fault {
  struct Place {
    int frame = 0;
    std::string a, b;  // shapes; b may be empty
    // As of lint::Mark.
    std::optional<Vec3d> at{}, normal{};
    std::optional<std::array<Vec3d, 2>> path{};
  };
  std::string cause;            // "flipped_normals"
  int count = 0, of = 0;        // occurrences, out of this many; 0: not counted
  int first = 0;                // frame
  std::vector<Place> places{};  // in the frames that are drawn
  std::vector<int> frames{};    // in which it occurs; of many a sample
  std::string detail{};         // of its first place: what is reported there, and what is
  bool is_condition = false;
  std::pair<std::string, double> fits{};  // as of lint::Finding
};

/// A pair over the frames of a sequence.
struct PairHistory {
  std::vector<int> frames{};
  std::vector<double> overlaps{};  // metres; NaN: no contact
  std::vector<double> points{};
};

/// One camera on a scenario, with the layers and panels that it shows.
struct View {
  std::string name = "main";
  ViewKind kind = ViewKind::Scene;
  /// Contact plane: number of reducer choices shown, the last with all scores. 0: the result.
  int choices = 0;
  std::optional<Vec3d> eye;  // metres; default: fitted
  std::optional<Vec3d> target;
  std::optional<double> fov_degrees;
  std::optional<double> orthographic_height;  // metres
  /// Length of an arrow in metres per newton second (loads: per newton); default: fitted.
  std::optional<double> impulse_scale;
  /// Title of its pictures, see view/title.h. Default: the scenario's.
  std::optional<std::string> title;
  ViewLayout layout = ViewLayout::One;
  /// Shows subjects smaller than 20 pixels again, magnified.
  bool inset = true;
  Focus focus = Focus::Contact;
  PairHistory history{};              // of two shapes in focus, if the trace is too long for memory
  std::vector<std::string> focus_on;  // names of shapes that the camera frames; empty: see `focus`
  Story story = Story::None;
  std::vector<Layer> layers;
  std::vector<Panel> panels;
  /// Charts of the panels plots and stability; default: all for which the sequence has values.
  std::optional<std::vector<Chart>> charts;
  std::vector<Fault> faults{};  // for the panel lint and Focus::Worst
  bool ignores_faults = false;  // others may be left out, by --ignore

  bool shows(Layer layer) const { return std::ranges::find(layers, layer) != layers.end(); }
  bool shows(Panel panel) const { return std::ranges::find(panels, panel) != panels.end(); }
  bool shows(Chart chart) const {
    return !charts || std::ranges::find(*charts, chart) != charts->end();
  }
  /// The place that lint names first in the drawn frames; nullptr if it names none.
  const Fault::Place* first_fault() const {
    for (const Fault& fault : faults)
      for (const Fault::Place& place : fault.places)
        if (!fault.is_condition && !place.a.empty()) return &place;
    return nullptr;
  }
};

}  // namespace contactscope
