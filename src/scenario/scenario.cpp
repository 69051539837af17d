#include "scenario/scenario.h"

#include "core/spell.h"
#include "scenario/readers.h"

namespace contactscope {
namespace {

namespace fs = std::filesystem;
using scenario_file::Value;

/// A hull of 100000 vertices written with 17 digits each takes 6 MB.
constexpr std::size_t kMaxScenarioBytes = std::size_t{16} << 20;

/// Maximum names in a dotted key. The deepest key of the format joins three, [shapes.crate.motion];
/// a table nested a hundred thousand deep would exhaust the stack.
constexpr int kMaxDottedNames = 16;

[[noreturn]] void fail_at(const std::string& path, std::string_view text, std::size_t offset,
                          const std::string& message) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw InputError(path, static_cast<int>(line), static_cast<int>(offset - line_start + 1),
                   message);
}

/// Offset after the string whose opening quote is at `start`, or the end if it does not close.
std::size_t skip_string(std::string_view text, std::size_t start) {
  const char quote = text[start];
  const bool escapes = quote == '"';
  const bool multi_line = text.substr(start, 3) == std::string(3, quote);
  const std::size_t width = multi_line ? 3 : 1;
  for (std::size_t i = start + width; i < text.size(); ++i) {
    if (escapes && text[i] == '\\') {
      ++i;
    } else if (text.substr(i, width) == std::string_view(text).substr(start, width)) {
      return i + width;
    } else if (!multi_line && text[i] == '\n') {
      return i;
    }
  }
  return text.size();
}

/// Skips strings and comments by TOML's grammar, and counts the names joined by dots.
void check_dotted_keys(const std::string& text, const std::string& path) {
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (c == '"' || c == '\'') {
      i = skip_string(text, i);
    } else {
      if (c == '.') {
        if (++dots >= kMaxDottedNames)
          fail_at(path, text, i,
                  "this key joins more than " + std::to_string(kMaxDottedNames) +
                      " names; a scenario nests no deeper than [shapes.NAME.motion]");
      } else if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-' &&
                 c != ' ' && c != '\t') {
        dots = 0;
      }
      ++i;
    }
  }
}

/// Throws InputError for known formats that are not supported.
void refuse_foreign(const std::string& path, std::string_view begin, std::uintmax_t size) {
  const std::string remedy = foreign_format_remedy(begin, size);
  if (!remedy.empty()) throw InputError(path, 1, 1, remedy);
}

/// Reads a whole scenario file. Throws InputError if it is missing, not a regular file, unreadable,
/// or too large. Only the beginning of a file that is too large is read.
std::string read_text(const std::string& path) {
  const auto refuse = [&](const std::string& message) { throw InputError(path, 0, 0, message); };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    refuse("there is no such file; give the path of a scenario (.toml)");
  if (error)
    refuse("cannot be accessed (" + error.message() +
           "); give the path of a scenario (.toml) that can be read");
  if (status.type() == fs::file_type::directory)
    refuse("this is a folder; give the path of a scenario (.toml) in it");
  require_regular_file(path, "give the path of a scenario (.toml)");
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  if (!error && size > kMaxScenarioBytes) {
    std::string begin(4096, '\0');
    in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    refuse_foreign(path, begin, size);
    refuse("the file has " + std::to_string(size) + " bytes; a scenario may have " +
           std::to_string(kMaxScenarioBytes) + ", and large meshes belong in an .obj file");
  }
  std::string text(error ? 0 : static_cast<std::size_t>(size), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (error || !in || in.gcount() != static_cast<std::streamsize>(text.size()))
    refuse("the file cannot be read; check its permissions");
  return text;
}

/// Checks the text before parsing. Throws InputError at the first byte that rules out a valid
/// document (empty, a NUL byte, not UTF-8, a key of too many names).
void check_text(const std::string& text, const std::string& path) {
  if (text.size() > kMaxScenarioBytes)
    throw InputError(path, 0, 0,
                     "the text has " + std::to_string(text.size()) +
                         " bytes; a scenario may have " + std::to_string(kMaxScenarioBytes));
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(path, 1, 1,
                     "the file is empty; a scenario needs a title and at least one [shapes.NAME]");
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\0')
      fail_at(path, text, i, "there is a NUL byte here; a scenario is a text file in UTF-8");
    const std::size_t length = utf8_length(text, i);
    if (length == 0)
      fail_at(path, text, i, "this byte is not UTF-8; save the file in that encoding");
    i += length;
  }
  check_dotted_keys(text, path);
}

/// Throws InputError. Text that is not TOML may be another known format.
toml::table document_of(const std::string& text, const std::string& path) {
  try {
    check_text(text, path);
    return scenario_file::parse_document(text, path);
  } catch (const InputError&) {
    refuse_foreign(path, text, text.size());
    throw;
  }
}

}  // namespace

std::string scenario_name(const std::string& path) {
  std::error_code error;
  fs::path whole = fs::absolute(path, error);
  if (error) whole = path;
  whole = whole.lexically_normal();
  const std::string group = whole.parent_path().filename().string();
  const std::string idea = whole.stem().string();
  return group.empty() ? idea : group + "/" + idea;
}

Scenario parse_scenario(const std::string& text, const std::string& path) {
  using namespace scenario_file;
  const toml::table document = document_of(text, path);
  const Value file = Value(path, document, "").table({"The file"});

  Scenario scenario;
  scenario.name = scenario_name(path);
  if (const std::string wrong = not_plain(scenario.name); !wrong.empty())
    throw InputError(printable(path), 0, 0,
                     "a scenario is named after its file and folder, and this name has " + wrong +
                         "; rename it");
  scenario.path = path;
  const auto patch = file.find("patch");
  std::optional<Value> title = file.find("title");
  if (!patch) title = file.require("title");
  if (title) {
    scenario.title = title->string();
    read_title(*title);
  }
  file.read("source", scenario.source);
  file.read("tags", scenario.tags,
            [](const Value& tags) { return mapped(tags.array(), &Value::non_empty_string); });
  file.read("up", scenario.up);
  if (patch) {
    read_patches(file, *patch, scenario);
    if (const auto words = file.find("words"))
      scenario.words = read_words_table(*words, names_in_pictures(scenario));
    return scenario;
  }
  if (const auto given = file.find("time")) {
    const Value time = given->table({"time"});
    time.read("frames", scenario.frames);
    time.read("dt", scenario.dt);
  }

  const Value shapes = file.require("shapes");
  PipelineSettings settings;
  file.read("pipeline", settings, read_pipeline);
  scenario.shapes =
      read_shapes(shapes, {fs::path(path).parent_path(), settings.scalar, scenario.warnings},
                  (scenario.frames - 1) * scenario.dt);
  const auto pairs = file.find("pairs"), world = file.find("world");
  scenario.broad_phase = read_broad_phase(world, pairs);
  scenario.pairs = pairs ? read_pairs(*pairs, scenario.shapes, settings)
                   : scenario.broad_phase.empty()
                       ? every_pair(scenario.shapes, settings, shapes)
                       : one_of_each_kind(scenario.shapes, settings, shapes);
  scenario.scalar = settings.scalar;
  scenario.pipeline = settings;
  leave_out_unanswered(scenario);
  scenario.world = read_world(world, scenario.up);
  scenario.solver = read_solver(file.find("solver"), scenario.shapes);
  warn_of_idle_keys(file, scenario);
  if (!scenario.broad_phase.empty()) scenario.pairs.clear();  // they represented their kinds
  scenario.views = {default_view()};
  check_title(*title, scenario);
  if (const auto views = file.find("views")) {
    scenario.views = read_views(*views);
    for (const Value& view : views->array_of_tables())
      if (const auto own = view.find("title")) check_title(*own, scenario);
  }
  for (View& view : scenario.views)
    if (!view.title) view.title = scenario.title;
  if (const auto words = file.find("words"))
    scenario.words = read_words_table(*words, names_in_pictures(scenario));
  if (const auto expect = file.find("expect"))
    scenario.expectations = read_expectations(*expect, scenario);
  scenario.snapshots = read_snapshots(file.find("snapshots"), scenario.frames, scenario.views);
  return scenario;
}

toml::table scenario_file::read_document(const std::string& path) {
  return document_of(read_text(path), path);
}

std::vector<std::string_view> names_in_pictures(const Scenario& scenario) {
  std::vector<std::string_view> names;
  for (const ScenarioShape& shape : scenario.shapes) {
    names.push_back(shape.name);
    names.push_back(kind_of_name(shape.name));
  }
  for (const ScenarioPair& pair : scenario.pairs) names.push_back(pair.label);
  std::erase(names, "");
  return names;
}

Words scenario_file::read_words_table(const Value& table,
                                      const std::vector<std::string_view>& names) {
  std::vector<std::string_view> known = known_words();
  known.insert(known.end(), names.begin(), names.end());
  Words words;
  for (const Value& entry : table.members()) {
    if (std::ranges::find(known, entry.name()) == known.end()) {
      const std::string near = nearest(entry.name(), known);
      entry.fail(
          "no picture has the word '" + entry.name() + "'; " +
          (near.empty() ? "`contactscope list words` prints all" : "did you mean '" + near + "'?"));
    }
    const std::string by = entry.string();
    if (!by.empty() && place_in(by) != place_in(entry.name()))
      entry.fail("'" + by + "' and '" + entry.name() + "' need the same place in braces");
    if (std::ranges::find(names, entry.name()) != names.end())
      words.rename(entry.name(), by);
    else
      words.replace(entry.name(), by);
  }
  return words;
}

Words load_words(const std::string& path, const std::vector<std::string_view>& names) {
  const toml::table document = scenario_file::read_document(path);
  const auto table = Value(path, document, "").find("words");
  return table ? scenario_file::read_words_table(*table, names) : Words();
}

std::vector<View> load_views(const std::string& path) {
  using namespace scenario_file;
  const toml::table document = read_document(path);
  const auto views = Value(path, document, "").find("views");
  if (!views) throw InputError(path, 1, 1, "there are no views; add one as [[views]]");
  return read_views(*views);
}

std::vector<std::string> scenario_files(const std::string& root, const char* ending) {
  std::vector<std::string> files;
  if (!fs::is_directory(root))
    throw InputError(root, 0, 0,
                     "no such folder; run where scenarios/ is, or give --scenarios DIR");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root))
    if (entry.is_regular_file() && entry.path().extension() == ending)
      files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

Scenario load_scenario(const std::string& path) { return parse_scenario(read_text(path), path); }

}  // namespace contactscope
