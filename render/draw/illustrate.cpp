#include <list>

#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

constexpr float kInPlace = 15;  // pixels: size of a label that replaces an entry of the legend
constexpr double kAway = 22;    // pixels: minimum length of its leader

constexpr std::array<bool Stages::*, 3> needs_of(Story story) {
  if (story == Story::ClipSteps) return {&Stages::clip};
  if (story == Story::None || story == Story::WalkSteps) return {};
  return {&Stages::gjk, &Stages::penetration};
}

// Labels are placed away from the middle of the contact.
Vec3d center_of_contact(const Scene& scene) {
  std::vector<Vec3d> points;
  for (const trace::Pair& pair : scene.frame.pairs) append(points, positions_of(pair));
  if (!points.empty()) return mean_of(points);
  for (const PlacedShape& shape : scene.shapes) {
    if (!shape.traced().half_space)
      points.push_back(shape.pose.transform(shape.traced().center_of_mass));
  }
  return points.empty() ? Vec3d(Vec3d::Zero()) : mean_of(points);
}

// Draws the view's layers; with `legend_alone` only those without explain() draw.
Sketch sketched(const Staging& staging, const Scene& scene, bool legend_alone) {
  Sketch sketch;
  if (!legend_alone) sketch.center = center_of_contact(scene);
  std::vector<std::pair<Layer, const LayerDrawing*>> layers;  // in drawing order
  for (std::size_t i = 0; i < staging.layers->size(); ++i) {
    if (!scene.shows(static_cast<Layer>(i))) continue;
    const LayerDrawing* layer = (*staging.layers)[i];
    if (layer->explain != nullptr) layer->explain(scene, sketch.legend);
    if (!legend_alone || layer->explain == nullptr)
      layers.emplace_back(static_cast<Layer>(i), layer);
  }
  std::string pair_name;  // of the pair that is being drawn
  const auto draw = [&](auto LayerDrawing::*part, const auto&... what) {
    for (const auto& [layer, drawn] : layers) {
      if (drawn->*part == nullptr) continue;
      if (!legend_alone) sketch.begin(name_of(layer), pair_name);
      (drawn->*part)(scene, what..., sketch);
    }
  };
  draw(&LayerDrawing::beneath);
  for (const trace::Pair& pair : scene.frame.pairs) {
    pair_name = pair.a + " " + pair.b;
    draw(&LayerDrawing::search, pair);
    if (!legend_alone) {
      sketch.begin(kPairLabelPart, pair_name);
      draw_pair_label(scene, pair, sketch);
    }
    // A story of clipping shows the pair's contacts in its last step.
    if (scene.view.story != Story::ClipSteps || !pair.clip ||
        scene.frame.frame > count_of(pair.clip->steps))
      draw(&LayerDrawing::result, pair);
  }
  pair_name.clear();
  draw(&LayerDrawing::above);
  draw_faults(scene, sketch);
  return sketch;
}

// Removes anchors outside the view, because a label there would not be drawn.
Legend seen_by(const Camera& camera, const Legend& legend) {
  Legend seen;
  for (LegendEntry entry : legend.entries()) {
    if (entry.anchor && !camera.sees(*entry.anchor)) entry.anchor.reset();
    seen.explain(entry);
  }
  return seen;
}

// Signs of panels have no anchor in the view.
void explain_side_panels(const View& view, const trace::Frame& frame, Legend& legend) {
  Legend of_panels;
  explain_panels(view, frame, of_panels);
  for (const LegendEntry& entry : of_panels.entries())
    legend.explain({entry.swatch, entry.text, std::nullopt, true});
}

// Labels the object itself if the legend has no room.
void label_in_place(const LegendEntry& entry, Sketch& sketch) {
  sketch.begin(kLegendPart);
  Label& label = sketch.label(*entry.anchor, label_of(entry), entry.swatch->ink, kInPlace, kAway);
  label.bold = false;
  label.leader = true;
}

bool has_sign(const LegendEntry& entry, const Sketch& sketch) {
  return std::ranges::find(sketch.legend.entries(), entry.swatch, &LegendEntry::swatch) !=
         sketch.legend.entries().end();
}

// One view of the picture: the whole scene, or a pair with its own viewport.
struct Shot {
  const PairViewport* viewport = nullptr;
  Layout layout;
  std::optional<trace::Frame> part{};  // the part of the frame that the scene shows
  std::optional<Scene> scene{};
  Sketch sketch{};
};

/// Whether a text contains this number, not as part of a longer one.
bool says(const std::string& text, const std::string& number) {
  const auto is_part = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '.');
  };
  for (std::size_t at = text.find(number); at != std::string::npos; at = text.find(number, at + 1))
    if ((at == 0 || !is_part(at - 1)) && !is_part(at + number.size())) return true;
  return false;
}

// If the title states a depth, writes it next to the deepest whisker, unless another label does.
void label_reported_depth(const Scene& scene, const std::string& title,
                          const std::list<Shot>& others, Sketch& sketch) {
  constexpr float kSize = 17;
  constexpr double kSideGap = 13;  // pixels
  if (scene.crowded() || !scene.shows(Layer::Contacts)) return;
  const auto is_labelled = [](const std::string& number) {
    return [&](const Shot& any) {
      return std::ranges::any_of(any.sketch.labels,
                                 [&](const Label& label) { return says(label.text, number); });
    };
  };
  for (const trace::Pair& pair : scene.frame.pairs) {
    const std::vector<PairPoint> kept = kept_points(pair);
    // Sketches of radii contain the depth already.
    if (kept.empty() || (scene.shows(Layer::Core) && !pair.incremental)) continue;
    const PairPoint deepest = *std::ranges::min_element(
        kept, {}, [](const PairPoint& at) { return at.point->separation; });
    for (const double metres : {pair.separation, deepest.point->separation}) {
      const std::string words =
          spell_length(std::abs(metres), scene.noise(pair), scene.scales.length);
      if (metres == 0 || !says(title, words)) continue;
      if (std::ranges::any_of(others, is_labelled(words))) return;
      const OnBoth whisker = whisker_at(scene, pair, deepest);
      sketch.begin(name_of(Layer::Contacts), pair.a + " " + pair.b);
      sketch.label(0.5 * (whisker.on_a + whisker.on_b), words, kContact, kSize, kSideGap,
                   Vec3d(-scene.camera.right()));
      return;
    }
  }
}

// A list, because scenes hold references to their frames.
std::list<Shot> shots_of(const Staging& staging, const trace::Frame& frame) {
  std::list<Shot> shots;
  if (staging.viewports.empty()) {
    Shot& shot = shots.emplace_back(Shot{.layout = staging.layout});
    shot.scene.emplace(scene_of(staging, frame));
    if (staging.magnifier) {
      shot.layout.insets.push_back(staging.magnifier->frame);
      // If the magnifier shows overlaps in true scale, the view does not exaggerate them.
      if (!staging.view.shows(Layer::Overlap) &&
          scales_within(*staging.magnifier, staging.scales).overlap == 1)
        shot.scene->scales.overlap = 1;
    }
  }
  for (const PairViewport& viewport : staging.viewports) {
    Shot& shot = shots.emplace_back(Shot{&viewport, staging.layout, part_of(frame, viewport)});
    shot.layout.framed = true;
    shot.layout.view = inside_of(viewport, staging.layout);
    shot.scene.emplace(Scene{viewport.view ? *viewport.view : staging.view, *staging.header,
                             *shot.part, staging.meshes, *viewport.camera, staging.scales,
                             staging.sequence.get()});
  }
  return shots;
}

/// In legend order, without entries whose translation is empty.
std::vector<LegendEntry> said_entries(const Legend& legend, const Staging& staging) {
  const Words* words = staging.layout.words;
  Legend said;  // before entries with the same sign are merged
  for (const LegendEntry& entry : legend.entries())
    if (words == nullptr || !words->of(entry.text).empty()) said.explain(entry);
  return said.sorted();
}

/// Reports how many shapes are outside of a view that does not follow them.
void report_absent(const Scene& scene, const Layout& layout, Drawing& drawing) {
  constexpr double kSize = 15, kInside = 6;  // pixels
  const auto is_absent = [&](const PlacedShape& shape) {
    return !shape.pose.position.allFinite() || !in_view(scene.camera, shape);
  };
  const auto absent = std::ranges::count_if(scene.shapes, is_absent);
  if (absent == 0) return;
  drawing.begin(kMomentPart);
  const Pen pen(drawing, layout.scale, kSize);
  pen.text(absent == 1 ? "1 shape has left the view"
                       : spell_count(absent) + " shapes have left the view",
           pixel(layout.view.x, layout.view.bottom() - pen.px(kInside)), Align::Left, kText,
           Weight::Bold, 0, 3);
}

}  // namespace

Scene scene_of(const Staging& staging, const trace::Frame& frame) {
  return {staging.view,   *staging.header,       frame, staging.meshes, staging.camera,
          staging.scales, staging.sequence.get()};
}

LegendChoice legend_of(const Staging& staging, const trace::Frame& frame) {
  Legend legend;
  for (const Shot& shot : shots_of(staging, frame)) {
    const Scene& scene = *shot.scene;
    legend.explain(seen_by(scene.camera, sketched(staging, scene, true).legend));
    for (const Inset& inset : staging.insets)
      legend.explain(seen_by(inset.camera, sketch_inset(inset, scene).sketch.legend));
  }
  explain_side_panels(staging.view, frame, legend);
  return choose_legend(said_entries(legend, staging));
}

Sketch sketch_frame(const Staging& staging, const trace::Frame& frame) {
  return sketched(staging, scene_of(staging, frame), false);
}

Drawing illustrate(const Staging& staging, const trace::Frame& frame) {
  if (staging.cells) return staging.cells->frame(frame.frame);
  Drawing drawing{.width = staging.layout.width, .height = staging.layout.height};
  drawing.words = staging.layout.words;
  std::list<Shot> shots = shots_of(staging, frame);
  Legend legend;
  std::vector<InsetPicture> insets;
  for (Shot& shot : shots) {
    shot.sketch = sketched(staging, *shot.scene, false);
    legend.explain(seen_by(shot.scene->camera, shot.sketch.legend));
  }
  for (const Inset& inset : staging.insets) {
    insets.push_back(sketch_inset(inset, *shots.front().scene));
    legend.explain(seen_by(inset.camera, insets.back().sketch.legend));
  }
  explain_side_panels(staging.view, frame, legend);
  const LegendChoice choice = choose_legend(said_entries(legend, staging));
  // With views side by side, one label in the first view that has the sign is enough.
  for (const LegendEntry& entry : choice.labelled) {
    const auto shot =
        std::ranges::find_if(shots, [&](const Shot& each) { return has_sign(entry, each.sketch); });
    if (shot != shots.end()) label_in_place(entry, shot->sketch);
  }
  const std::string title = fill_title(staging, frame);
  const auto is_written_nearby = [&](const Shot& shot) {
    return shot.scene->scales.overlap != staging.scales.overlap;
  };
  for (Shot& shot : shots)
    if (!is_written_nearby(shot)) label_reported_depth(*shot.scene, title, shots, shot.sketch);
  for (Shot& shot : shots) {
    const Camera& camera = shot.scene->camera;
    Sketch* const sketch = &shot.sketch;
    sketch->begin(kShapeNamesPart);
    draw_shape_names(*shot.scene, *sketch);
    compose(*sketch, camera, shot.layout, drawing);
    if (shot.viewport != nullptr)
      draw_viewport_frame(*shot.viewport, staging.view, frame, staging.layout, drawing);
    const auto middle = staging.magnifier ? magnified_middle(staging.view, frame) : std::nullopt;
    if (middle) {
      // Exaggeration for the view may not be necessary in the magnifier.
      const SequenceScales near_by = scales_within(*staging.magnifier, staging.scales);
      std::string note;
      Scene magnified = *shot.scene;
      if (near_by.overlap != staging.scales.overlap) {
        magnified.scales = near_by;
        *sketch = sketched(staging, magnified, false);
        note = near_by.overlap == 1 ? ", overlap to scale"
                                    : ", overlap" + spell_factor(near_by.overlap);
      }
      // Only labels at the middle are repeated in the magnifier.
      std::erase_if(sketch->labels,
                    [&](const Label& label) { return !label.at.isApprox(*middle, 1e-12); });
      if (is_written_nearby(shot)) label_reported_depth(magnified, title, {}, *sketch);
      draw_magnified(*staging.magnifier, *middle, *sketch, note, camera, staging.layout, drawing);
    }
  }
  for (std::size_t i = 0; i < insets.size(); ++i) {
    for (const LegendEntry& entry : choice.labelled)
      if (has_sign(entry, insets[i].sketch)) label_in_place(entry, insets[i].sketch);
    draw_inset(staging.insets[i], insets[i], staging.layout, drawing);
  }
  if (staging.style.legend) draw_legend(choice.listed, staging.layout, drawing);
  if (staging.leaves_out) report_absent(*shots.front().scene, staging.layout, drawing);
  draw_captions(title, staging.header->source, staging.moments.of(frame), staging.layout, drawing);
  return drawing;
}

Stages stages_shown(const std::vector<View>& views) {
  Stages stages = Stages::none();
  const auto add = [&](const auto& needs) {
    for (const auto stage : needs)
      if (stage != nullptr) stages.*stage = true;
  };
  for (const View& view : views) {
    for (const Layer layer : view.layers) add(kLayers[static_cast<std::size_t>(layer)]->needs);
    for (const Panel panel : view.panels) add(kPanels[static_cast<std::size_t>(panel)]->needs);
    add(needs_of(view.story));
    if (view.title) add_stages(parse_title(*view.title).title, stages);
    stages.reduction = stages.reduction || view.kind == ViewKind::ContactPlane;
  }
  return stages;
}

}  // namespace contactscope::draw
