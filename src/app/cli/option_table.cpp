#include "app/cli/options.h"
#include "app/render/formats/format.h"
#include "reduce/reducer.h"
#include "study/study.h"

namespace contactscope::app {
namespace {

using Kind = OptionValues::Kind;

const OptionValues kAny{}, kScenario{Kind::Scenario}, kFile{Kind::File}, kFolder{Kind::Folder};
constexpr bool kUnrecorded = false;

template <class Names> OptionValues named(Kind kind, const Names& names) {
  return {kind, mapped(names, [](const auto& name) { return std::string(name); })};
}

template <class Names> OptionValues list_or_none(const Names& names) {
  OptionValues values = named(Kind::List, names);
  values.words.insert(values.words.begin(), "none");
  return values;
}

OptionValues only(const std::vector<std::string>& names) { return {Kind::Words, names, true}; }

OptionValues implied(const std::string& value) { return {.implied = value}; }

OptionValues between(double min, double max) { return {.min = min, .max = max}; }

std::string help_of_formats() {
  std::string help = "Formats, as png,apng:";
  for (const Format& format : formats())
    help += (help.ends_with(':') ? " " : "; ") + std::string(format.name) + " (" +
            std::string(format.what) + ")";
  return help;
}

/// The default of an option; empty if it is zero or not set.
std::string default_of(const Target& to) {
  static const Options defaults;
  std::ostringstream text;
  std::visit(
      [&](auto member) {
        if constexpr (requires { text << defaults.*member; })
          if (defaults.*member != std::decay_t<decltype(defaults.*member)>{})
            text << defaults.*member;
      },
      to);
  return text.str();
}

/// All options, in the order of the help.
const std::vector<Option>& option_table() {
  constexpr auto kInputs = &Options::scenarios;
  const std::string drawing = "render explore";
  static const std::vector<Option> table = {
      {"SCENARIO...", "", "render", kInputs,
       "Files, folders, or names such as hull/face_contact; traces (*.jsonl) are drawn too",
       kScenario},
      {"SCENARIO...", "", "versus", kInputs,
       "Files, folders or names; or traces, whose own contacts are judged too", kScenario},
      {"[SCENARIO...]", "", "check", kInputs,
       "Scenarios, or traces of any engine; default: all scenarios. With --accept: the findings to "
       "accept",
       kScenario},
      {"SCENARIO", "", "trace", kInputs, "A file or a name", kScenario},
      {"SCENARIO", "", "explore", kInputs,
       "A file or a name; or a trace, whose points are reduced to four", kScenario},
      {"NAME", "", "study", &Options::study, "A name that `list studies` prints",
       named(Kind::Words, names_in(studies()))},
      {"[SCENARIO...]", "", "study", kInputs,
       "For flip_distance: the scenarios with the pairs; other studies make their own cases",
       kScenario},
      {"FILE...", "", "lint", kInputs,
       "Traces of any engine, - for the standard input; or scenarios, which are run", kFile},
      {"[FILE...]", "", "doctor", kInputs,
       "Scenarios and traces to inspect: their content, and what `lint` finds in traces", kFile},
      {"FILE", "", "shrink", kInputs,
       "A scenario, which is run, or a trace of any engine, - for the standard input", kFile},
      {"FILE", "", "import", kInputs, "MJCF, URDF or SDF", kFile},
      {"FILE", "", "why", kInputs, "A scenario, or a trace of any engine", kScenario},
      {"FILE", "", "find", kInputs, "A trace of any engine, - for the standard input", kFile},
      {"EXPRESSION", "", "find", &Options::condition,
       "The condition, as 'overlap > 5 mm and normal_turn > 20 deg'; see below"},
      {"FILE...", "", "diff", kInputs, "Two traces of the same scene", kFile},
      {"KEY...", "", "show", kInputs,
       "Findings, such as hull/face_contact/frame_0012, folders, or patterns with *"},
      {"[WHAT]", "", "list", &Options::what,
       "scenarios, reducers, broad_phases, continuous, layers, panels, studies; words, the texts "
       "in pictures; sources, what shows each claim of the documents; one of these; or course, the "
       "scenes in the order to learn from",
       only(kListed)},
      {"[DOCUMENT]", "", "list", &Options::document, "After sources: only the claims of this one",
       only(kDocumentNames)},
      {"[VERB]", "", "help", &Options::what,
       "A verb that contactscope --help lists; or scenario, for all keys of a scenario. trace also "
       "prints those of a trace"},

      {"--engines", "NAME,...", "versus", &Options::engines,
       "Engines, as contactscope,bullet; default: all that are found"},
      {"--rollout", "", "versus", &Options::rollout,
       "Each engine steps the dynamic scene itself; judge the motion"},
      {"--while", "EXPRESSION", "shrink", &Options::condition,
       "The condition to preserve, as 'float.points != double.points'; see below"},
      {"--picture", "FILE", "diff", &Options::picture,
       "Also draw both runs in the frame in which they part, and their distance over time, as PNG",
       kFile},
      {"--strict", "", "lint find render", &Options::strict,
       "Also report what is below a threshold"},
      {"--ignore", "CAUSE[:SHAPE]", "lint find render", &Options::ignored,
       "Leave out the findings of a cause, or those of it that are about a shape; several have "
       "commas between them, or an option each"},
      {"--tolerance", "METRES", "lint find render", &Options::tolerance,
       "Allowed error of positions and separations; default: 0.2 % of the smaller shape",
       between(0, 1e6)},
      {"--known", "FILE", "lint find render", &Options::known,
       "Leave out each finding that is in this file, and is at most half as frequent again; with "
       "--strict each of its pairs. `lint` exits with 0 if no other one is left",
       kFile},
      {"--write-known", "FILE", "lint", &Options::write_known,
       "Write the findings to a file for --known, and exit with 0", kFile},
      {"--snapshots", "DIR", "check list", &Options::snapshot_root,
       "Folder of the stored snapshots", kFolder},
      {"--write-missing", "", "check", &Options::write_missing,
       "Store snapshots that are missing; change no others"},
      {"--update", "", "check", read<&Options::update, parse_update>,
       "Replace the snapshots that fail, or with --update=all all of them", implied("failed")},
      {"--accept", "", "check", &Options::accept,
       "Store the results of the last report without running anything. Names are such as "
       "hull/face_contact/frame_0012, folders, or patterns with *"},
      {"--as", "WORD", "check", &Options::accept_as,
       "Accept as a further version next to the stored one: osmesa for the picture of that driver, "
       "bad_31 for a bug that `check` should recognize"},
      {"--note", "TEXT", "check", &Options::note, "Comment that is stored with --as bad_31"},
      {"--facts-only", "", "check", &Options::facts_only,
       "Compare traces and expectations; draw nothing, open no OpenGL"},
      {"--list", "", "review", &Options::list_only, "Print one line per finding; ask nothing"},
      {"--from", "FILE", "review", &Options::from,
       "Apply the decisions in a file, {\"accept\": [...], \"reject\": [...]}, which report.html "
       "saves; - is the standard input",
       kFile},
      {"--pictures", "METHOD", "show", &Options::pictures,
       "How the terminal draws: blocks, kitty, none", only({"auto", "blocks", "kitty", "none"})},

      {"--size", "WxH", "render explore study versus diff", read<&Options::size, parse_size>,
       "Default 1280x720, and 1280x1440 to compare more than 9 reducers or methods"},
      {"--width", "LENGTH", drawing, read<&Options::width, parse_length>,
       "Width of the figure, as 84mm, 8.4cm, 3.3in, 240pt or 992px, instead of --size; the layout "
       "adapts"},
      {"--height", "LENGTH", drawing, read<&Options::height, parse_length>,
       "Height, with --width; default: as much as the content needs"},
      {"--font-size", "LENGTH", drawing, read<&Options::font_size, parse_length>,
       "Font size of legends and panels, as 8pt; default 8pt if --width is in mm, cm, in or pt"},
      {"--dpi", "NUMBER", drawing, &Options::dpi, "Pixels per inch of --width and --font-size",
       between(36, 2400)},
      {"--scale", "FACTOR", drawing, &Options::scale, "Factor of all sizes: text, lines and marks",
       between(0.1, 10)},
      {"--line-width", "FACTOR", drawing, &Options::line_width, "Factor of line widths",
       between(0.1, 10)},
      {"--bare", "", drawing, &Options::bare, "Without title, legend and footer"},
      {"--no-title", "", drawing, &Options::no_title, "Without the title"},
      {"--no-legend", "", drawing, &Options::no_legend, "Without the legend"},
      {"--no-footer", "", drawing, &Options::no_footer, "Without source, frame and time"},
      {"--background", "COLOUR", drawing, read<&Options::background, parse_background>,
       "transparent, white or #RRGGBB; default: the theme's",
       named(Kind::Words, std::array{"transparent", "white"})},
      {"--theme", "NAME", drawing, read<&Options::theme, parse_theme>,
       "Colours: light, dark, grey or print", named(Kind::Words, draw::kThemeNames)},
      {"--words", "FILE", drawing, &Options::words,
       "TOML file with replacements of the texts in pictures", kFile},
      {"--font", "FILE,...", drawing, &Options::fonts,
       "TrueType file for characters that the built-in font lacks; or two, regular,bold", kFile},

      {"--layers", "NAME,...", "render", read<&Options::layers, parse_layers>,
       "Layers to draw instead of those of the views, as shapes,contacts; or none",
       list_or_none(kLayerNames)},
      {"--panels", "NAME,...", "render", read<&Options::panels, parse_panels>,
       "Panels to draw instead of those of the views, as summary,contact_plane; or none",
       list_or_none(kPanelNames)},
      {"--pair", "A,B", "render", &Options::pair, "Show only these two shapes and their contacts"},
      {"--pair", "A,B", "shrink", &Options::pair, "Search only these two shapes"},
      {"--pair", "A,B", "why", &Options::pair, "The two shapes; default: the first that touch"},
      {"--point", "N", "why", &Options::point, "Only this contact point of theirs, from 0"},
      {"--shapes", "NAME,...", "render", &Options::shapes,
       "Show only these shapes, as crate,floor"},
      {"--focus", "NAME,...", "render", &Options::focus,
       "What the camera frames: names of shapes, as crate,floor; or contacts, shapes, deepest (the "
       "pair with the largest overlap) or worst (what lint names first, without --frames in its "
       "frame; else the largest overlap for the size of its smaller body)"},
      {"--where", "EXPRESSION", "render", &Options::condition,
       "Only frames with a pair for which the condition holds, and the contacts of such pairs; see "
       "`help find`"},
      {"--eye", "X,Y,Z", "render", &Options::eye, "Position of the camera in metres"},
      {"--target", "X,Y,Z", "render", &Options::target,
       "Point that the camera looks at, in metres"},
      {"--fov", "DEGREES", "render", &Options::fov_degrees, "Field of view of the camera",
       between(1, 150)},
      {"--camera", "NUMBER,...", "render", &Options::camera,
       "Eye, target and field of view at once, as 4,2,4,0,0,0,30"},
      {"--orthographic", "", "render", read<&Options::orthographic_height, parse_orthographic>,
       "Without perspective; --orthographic=1.5 shows 1.5 m of height", implied("fitted")},
      {"--timing", "", "render", &Options::timing,
       "Show the measured time of the pipeline in the summary panel"},
      {"--format", "NAME,...", "render list", &Options::formats, help_of_formats(),
       named(Kind::List, names_in(formats())), kUnrecorded},
      {"--strip", "N", "render", &Options::strip,
       "One picture of N frames, side by side, with one legend"},
      {"--columns", "N", "render", &Options::columns,
       "Columns of --strip or --sheet; default: up to four"},
      {"--sheet", "", "render", &Options::sheet,
       "One picture of all scenarios, a thumbnail of each with its name"},
      {"--fps", "NUMBER", "render", &Options::fps,
       "Pictures per second of an animation, instead of the times of the frames",
       between(0.1, 240)},
      {"--anchors", "", "render", &Options::anchors,
       "Also write a JSON file per picture with the places of points, faces and labels in it", kAny,
       kUnrecorded},

      {"--cases", "N", "study", &Options::cases, "Cases per point of a line; default: the study's",
       between(1, 1000000)},
      {"--seed", "N", "study", &Options::seed, "Seed of the random cases"},
      {"--table", "", "explore study versus", &Options::tables_only,
       "Write no pictures, and open no OpenGL"},
      {"--json", "", "render", &Options::json, "Print the paths of the pictures as JSON", kAny,
       kUnrecorded},
      {"--json", "", "trace", &Options::json, "Accepted; a trace is always JSON lines"},
      {"--json", "", "check", &Options::json,
       "Print the findings as JSON, the content of OUT/check/findings.json"},
      {"--json", "", "review lint find diff versus shrink doctor list", &Options::json,
       "Print as JSON"},
      {"--json", "", "explore", &Options::json, "Print JSON lines, one per frame and pair"},
      {"--json", "", "study", &Options::json, "Also print the results as JSON lines"},
      {"--junit", "FILE", "check", &Options::junit,
       "Also write a JUnit XML file, with pictures attached", kFile},
      {"--markdown", "FILE", "check", &Options::markdown,
       "Also write a summary in Markdown, with small pictures in it", kFile},
      {"--github", "", "check", &Options::github,
       "Also print annotations for GitHub, one per cause"},
      {"--frames", "A:B[:STEP]", "render trace explore study lint find why versus shrink",
       read<&Options::frames, parse_frames>,
       "Only frames A to B, B included. `versus --rollout` draws the last of them", kAny,
       kUnrecorded},
      {"--reducer", "NAME", "render trace explore", &Options::reducer, "Reducer for every pair",
       named(Kind::Words, names_in(reducers()))},
      {"--rose", "", "explore", &Options::rose,
       "Draw the moments that the kept points resist, by direction, instead of the area"},
      {"--triangle", "NUMBER", "render trace", &Options::triangle,
       "Triangle of a mesh whose separating axes and clipping are recorded and drawn, instead of "
       "the deepest contact's",
       between(0, 1e6)},
      {"--time-limit", "SECONDS", "versus shrink", &Options::time_limit,
       "Time that the program of an engine may take", between(0.01, 1e6)},
      {"--shard", "K/N", "render", read<&Options::shard, parse_shard>,
       "Only part K of N of the scenarios, as 2/5; their pictures are in --out", kAny, kUnrecorded},
      {"--shard", "K/N", "check", read<&Options::shard, parse_shard>,
       "Only part K of N of all scenarios, as 2/5; the report is in OUT/check_2_of_5"},
      {"--out", "DIR", "render list check review show explore study versus shrink", &Options::out,
       "Folder to write to", kFolder, kUnrecorded},
      {"--backend", "NAME", "render check explore study versus diff",
       read<&Options::backend, parse_backend>,
       "auto, egl or osmesa; default: $CONTACTSCOPE_BACKEND, else auto",
       named(Kind::Words, std::array{"auto", "egl", "osmesa"}), kUnrecorded},
      {"--view", "NAME", "render check explore", &Options::view,
       "Only this view; for a trace FILE.toml, or FILE.toml:NAME, which contains views", kFile,
       kUnrecorded},
      {"--jobs", "N", "render explore versus", &Options::jobs,
       "Encoder threads; 0: one per processor", between(0, 256), kUnrecorded},
      {"--scenarios", "DIR", "", &Options::scenario_root,
       "Folder in which scenario names are looked up", kFolder, kUnrecorded},
      {"--quiet", "", "", &Options::quiet, "Print only results and errors", kAny, kUnrecorded},
      {"--verbose", "", "", &Options::verbose,
       "Print what ran, how long it took, and what was left out", kAny, kUnrecorded},
  };
  return table;
}

}  // namespace

std::vector<const Option*> options_of(const std::string& verb) {
  std::vector<const Option*> found;
  for (const Option& option : option_table())
    if (option.verbs.empty() ||
        (" " + option.verbs + " ").find(" " + verb + " ") != std::string::npos)
      found.push_back(&option);
  return found;
}

std::string Option::name() const {
  std::string plain = usage;
  std::erase_if(plain, [](char c) { return c == '[' || c == ']' || c == '.'; });
  return plain;
}

bool Option::takes_value() const {
  return !std::holds_alternative<bool Options::*>(to) && values.implied.empty();
}

bool Option::repeats() const {
  if (is_argument()) return usage.find("...") != std::string::npos;
  return values.kind == Kind::List ||
         std::holds_alternative<std::vector<std::string> Options::*>(to) ||
         std::holds_alternative<std::vector<double> Options::*>(to);
}

std::string Option::description() const {
  std::ostringstream notes;
  notes.precision(10);
  if (values.min < values.max) notes << values.min << " to " << values.max;
  const std::string otherwise = default_of(to);
  if (!otherwise.empty()) notes << (notes.str().empty() ? "" : "; ") << "default: " << otherwise;
  return notes.str().empty() ? help : help + " (" + notes.str() + ")";
}

}  // namespace contactscope::app
