#include "app/cli/narrow.h"

#include "app/cli/faults.h"
#include "draw/scene/pairs.h"

namespace contactscope::app {
namespace {

constexpr std::string_view kTomlEnd = ".toml";

std::optional<Vec3d> place_named(const std::string& option, const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  if (numbers.size() != 3) throw UsageError(option + " is three numbers, as " + option + "=1,2,3");
  return Vec3d(numbers[0], numbers[1], numbers[2]);
}

/// Expands --camera into --eye, --target and --fov, which take precedence.
Options with_camera(Options options) {
  const std::vector<double>& all = options.camera;
  if (all.empty()) return options;
  if (all.size() < 6 || all.size() > 7)
    throw UsageError(
        "--camera is the eye, the point that it looks at and the field of view in degrees, as "
        "--camera=4,2,4,0,0,0,30");
  if (all.size() == 7 && !(all[6] >= 1 && all[6] <= 150))
    throw UsageError("the field of view of --camera must be 1 to 150 degrees");
  if (options.eye.empty()) options.eye = {all[0], all[1], all[2]};
  if (options.target.empty()) options.target = {all[3], all[4], all[5]};
  if (all.size() == 7 && options.fov_degrees == 0) options.fov_degrees = all[6];
  return options;
}

/// The word of --focus; nothing if it names shapes.
std::optional<Focus> word_in_focus(const Options& options) {
  if (options.focus.size() != 1) return std::nullopt;
  const std::string& word = options.focus.front();
  return word_named<Focus>(kFocusNames, word == "contacts" ? "contact" : word);
}

void show_lint(View& view, const Options& options) {
  if (options.panels || view.kind != ViewKind::Scene) return;
  // The panel `lint` lists as many pairs of the condition as there is room for.
  if (!options.condition.empty()) std::erase(view.panels, Panel::Worst);
  if (!view.shows(Panel::Lint)) view.panels.insert(view.panels.begin(), Panel::Lint);
}

/// Number of items that a layer added to a picture.
std::size_t drawn_by(const draw::Sketch& sketch) {
  return sketch.surfaces.size() + sketch.curves.size() + sketch.lines.size() +
         sketch.arrows.size() + sketch.marks.size() + sketch.labels.size() + sketch.bodies.size();
}

}  // namespace

void require_shape(const std::vector<std::string_view>& names, const std::string& option,
                   const std::string& name) {
  if (std::ranges::find(names, name) != names.end()) return;
  throw UsageError(option + ": there is no shape '" + name + "'; " + near_or_all(name, names));
}

find::Expression condition_of(const std::string& option, const std::string& text,
                              const find::Vocabulary& words) {
  try {
    return find::Expression(text, words);
  } catch (const find::ExpressionError& error) {
    throw UsageError(option + ", " + error.what());
  }
}

void keep_where(Sequence& sequence, Input& input, std::vector<View>& views,
                const Options& options) {
  find::Finder finder(condition_of("--where", options.condition));
  if (finder.wants_lint()) {
    lint::LintOptions to_lint = linter_options(options);
    to_lint.is_marked = [](int) { return true; };
    std::vector<lint::Finding> findings = lint_input(input, to_lint);
    const KnownFindings known(options);
    std::erase_if(findings, [&](auto& one) { return known.knows(input.file, one); });
    finder.take(findings);
  }
  using Name = std::tuple<std::string, std::string, std::string>;
  std::map<int, std::set<Name>> found;
  const auto numbers =
      sequence.file ? sequence.numbers : mapped(sequence.frames, &trace::Frame::frame);
  sequence.each(numbers, [&](std::size_t index) {
    for (find::Hit& hit : finder.next(sequence.frames[index]))
      found[hit.frame].emplace(std::move(hit.a), std::move(hit.b), std::move(hit.label));
  });
  std::erase_if(input.frames, [&](int frame) { return !found.contains(frame); });
  if (std::ranges::any_of(sequence.frames, draw::is_heap)) {
    Fault marked{options.condition};
    for (const auto& [frame, names] : found)
      for (const auto& [a, b, label] : names) marked.places.push_back({frame, a, b});
    for (const auto& [frame, names] : found) marked.frames.push_back(frame);
    marked.count = count_of(marked.places);
    marked.is_condition = true;
    const auto is_elsewhere = [&](const Fault::Place& place) {
      const auto here = found.find(place.frame);
      return here == found.end() || std::ranges::none_of(here->second, [&](const Name& name) {
               return std::get<0>(name) == place.a && std::get<1>(name) == place.b;
             });
    };
    const auto is_of_first = [&](const Fault::Place& one) {
      return one.a == marked.places.front().a && one.b == marked.places.front().b;
    };
    const bool is_one_pair = !found.empty() && std::ranges::all_of(marked.places, is_of_first);
    for (View& view : views) {
      if (is_one_pair && options.focus.empty() && !view.eye)
        view.focus_on = {marked.places.front().a, marked.places.front().b};
      for (Fault& fault : view.faults) std::erase_if(fault.places, is_elsewhere);
      view.faults.push_back(marked);
      show_lint(view, options);
    }
    return;
  }
  sequence.trim = [trim = sequence.trim, found](trace::Frame& frame) {
    if (trim) trim(frame);
    const auto of_frame = found.find(frame.frame);
    std::erase_if(frame.pairs, [&](const trace::Pair& pair) {
      return of_frame == found.end() || !of_frame->second.contains({pair.a, pair.b, pair.label});
    });
  };
  std::ranges::for_each(sequence.frames, sequence.trim);
}

std::function<bool(const trace::Pair&)> chosen_pair(const trace::Header& header,
                                                    const Options& options) {
  if (options.pair.empty()) return [](const trace::Pair&) { return true; };
  for (const std::string& name : options.pair)
    require_shape(names_in(header.shapes), "--pair", name);
  return [two = options.pair](const trace::Pair& pair) {
    return (pair.a == two[0] && pair.b == two[1]) || (pair.a == two[1] && pair.b == two[0]);
  };
}

void narrow(Sequence& sequence, const Options& options) {
  if (!word_in_focus(options)) {
    std::vector<std::string_view> names = names_in(sequence.header.shapes);
    if (options.focus.size() == 1)
      names.insert(names.end(), kFocusNames.begin(), kFocusNames.end());
    for (const std::string& name : options.focus) require_shape(names, "--focus", name);
  }
  for (const lint::Ignored& one : linter_options(options).ignored)
    if (!one.shape.empty()) require_shape(names_in(sequence.header.shapes), "--ignore", one.shape);
  if (options.pair.empty() && options.shapes.empty()) return;
  const auto is_pair = chosen_pair(sequence.header, options);
  std::set<std::string> shown(options.shapes.begin(), options.shapes.end());
  for (const std::string& name : shown)
    require_shape(names_in(sequence.header.shapes), "--shapes", name);
  shown.insert(options.pair.begin(), options.pair.end());
  sequence.trim = [shown, is_pair](trace::Frame& frame) {
    std::erase_if(frame.poses,
                  [&](const trace::Placement& one) { return !shown.contains(one.first); });
    std::erase_if(frame.pairs, [&](const trace::Pair& pair) {
      return !is_pair(pair) || !shown.contains(pair.a) || !shown.contains(pair.b);
    });
    const auto hidden = [&](const auto& one) { return !shown.contains(one.name); };
    std::erase_if(frame.deformed, hidden);
    std::erase_if(frame.field_slices, hidden);
    if (frame.broad_phase) {
      std::erase_if(frame.broad_phase->bounds, hidden);
      std::erase_if(frame.broad_phase->end_swaps, [&](const trace::EndSwap& swap) {
        return !shown.contains(swap.lower) || !shown.contains(swap.upper);
      });
    }
    if (!frame.solver) return;
    std::erase_if(frame.solver->bodies, hidden);
    std::erase_if(frame.solver->stops, [&](const trace::Stop& stop) {
      return !shown.contains(stop.a) || !shown.contains(stop.b);
    });
  };
  std::ranges::for_each(sequence.frames, sequence.trim);
}

void place_focus(std::vector<View>& views, const Options& options) {
  for (View& view : views) {
    const std::optional<Focus> word = word_in_focus(options);
    if (word) view.focus = *word;
    view.focus_on = word ? std::vector<std::string>() : options.focus;
    if (word == Focus::Worst) show_lint(view, options);
  }
}

void place_camera(std::vector<View>& views, const Options& all) {
  const Options options = with_camera(all);
  const std::optional<Vec3d> eye = place_named("--eye", options.eye);
  const std::optional<Vec3d> target = place_named("--target", options.target);
  for (View& view : views) {
    if (view.kind != ViewKind::Scene) continue;
    if (eye) view.eye = eye;
    if (target) view.target = target;
    if (view.eye && view.target && *view.eye == *view.target)
      throw UsageError("--eye and --target are the same point; move one of them");
    if (options.fov_degrees > 0) {
      view.fov_degrees = options.fov_degrees;
      view.orthographic_height.reset();
    }
    if (options.orthographic_height) view.orthographic_height = options.orthographic_height;
  }
}

bool views_are_of_file(const Options& options) {
  return options.view.find(kTomlEnd) != std::string::npos;
}

std::vector<View> views_of_file(const Options& options) {
  namespace fs = std::filesystem;
  if (!views_are_of_file(options)) return {};
  const std::string& text = options.view;
  const std::size_t end = text.find(kTomlEnd);
  const std::string file = text.substr(0, end + kTomlEnd.size());
  const std::string rest = text.substr(end + kTomlEnd.size());
  if (!fs::exists(file)) throw UsageError("--view '" + text + "': there is no file " + file);
  std::vector<View> views = load_views(file);
  if (rest.empty()) return views;
  const std::string name = rest.substr(1);
  const std::string all = names_of(views);
  std::erase_if(views, [&](const View& view) { return rest[0] != ':' || view.name != name; });
  if (views.empty())
    throw UsageError("--view '" + text + "' is not a view of " + file + "; it has " + all);
  return views;
}

std::vector<std::string> idle_layers(const draw::Staging& staging,
                                     const std::vector<trace::Frame>& frames) {
  constexpr std::size_t kMaxFrames = 50;
  if (staging.cells != nullptr) return {};  // contact planes have no layers
  const std::size_t step = std::max<std::size_t>(1, frames.size() / kMaxFrames);
  draw::Staging none = staging;
  none.view.layers.clear();
  std::vector<std::string> idle;
  for (const Layer layer : staging.view.layers) {
    draw::Staging alone = staging;
    alone.view.layers = {layer};
    bool draws = false;
    for (std::size_t f = 0; f < frames.size() && !draws; f += step)
      draws = drawn_by(draw::sketch_frame(alone, frames[f])) >
              drawn_by(draw::sketch_frame(none, frames[f]));
    if (!draws) idle.emplace_back(name_of(layer));
  }
  return idle;
}

}  // namespace contactscope::app
