#include "app/cli/trace_file.h"

#include <iostream>

#include "core/input_error.h"
#include "core/spell.h"
#include "snapshot/meshes.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "-";
constexpr const char* kOnlyHeader = "there is only a header; each frame is a line after it";
constexpr std::string_view kBlank = " \t\r\n";

/// Copies a pipe to a temporary file for repeated reading. The file has no name, so it disappears
/// with the process.
std::unique_ptr<std::istream> spooled(std::istream& in) {
  std::string path = (fs::temp_directory_path() / "contactscope-XXXXXX").string();
  const int file = mkstemp(path.data());
  if (file >= 0) close(file);
  std::ofstream out(path, std::ios::binary);
  if (in.peek() != std::istream::traits_type::eof()) out << in.rdbuf();
  out.close();
  auto again = std::make_unique<std::ifstream>(path, std::ios::binary);
  const bool is_whole = file >= 0 && out && *again;
  fs::remove(path);
  if (!is_whole)
    throw InputError("standard input", 0, 0,
                     "it cannot be stored in " + fs::temp_directory_path().string() +
                         " to be read twice; make room there, or write it to a file");
  return again;
}

std::unique_ptr<std::istream> opened(const std::string& path, TraceFile::Passes passes) {
  if (path == kStandardInput)
    return passes == TraceFile::Passes::Several ? spooled(std::cin) : nullptr;
  require_regular_file(path, "give a trace (.jsonl), or pipe it in and write - as its name");
  auto in = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*in) throw InputError(path, 0, 0, "this file cannot be read; check its permissions");
  if (!fs::is_regular_file(path)) return in;
  std::string header;
  std::getline(*in, header);
  if (!snapshot::meshes_named(header).empty())  // stored by `check`, so it has few frames
    return std::make_unique<std::istringstream>(
        snapshot::with_meshes(snapshot::read_text_file(path).value_or(""), path));
  in->clear();
  in->seekg(0);
  return in;
}

std::string begin_of(const std::string& path) {
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown)) return {};
  std::string begin(1 << 16, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  return begin;
}

/// Whether the name is that of a scene of meshes: glTF, COLLADA or 3MF.
bool is_scene(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".gltf" || ending == ".glb" || ending == ".dae" || ending == ".3mf";
}

trace::Trace read_whole(TraceFile& file) {
  trace::Trace trace;
  while (std::optional<trace::Frame> frame = file.next()) {
    frame->shapes.clear();  // they are in the header now
    trace.frames.push_back(std::move(*frame));
  }
  trace.header = file.header();
  return trace;
}

}  // namespace

bool is_trace_file(const std::string& path) {
  if (path == kStandardInput) return true;
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown) || is_scene(path)) return false;
  if (fs::path(path).extension() == ".jsonl") return true;
  std::ifstream in(path, std::ios::binary);
  char first = ' ';
  while (kBlank.find(first) != std::string_view::npos && in.get(first)) continue;
  return in && first == '{';
}

std::string foreign_in(const std::string& path) {
  const std::string begin = begin_of(path);
  return begin.empty() ? "" : foreign_format_remedy(begin, fs::file_size(path));
}

bool is_model(const std::string& path) {
  if (is_scene(path)) return true;
  const std::string format = foreign_format(begin_of(path), 0);
  return std::ranges::any_of(std::array{"MJCF", "URDF", "SDFormat"},
                             [&](const char* model) { return format.starts_with(model); });
}

TraceFile::TraceFile(const std::string& path, Passes passes)
    : name_(path == kStandardInput ? "standard input" : path), own_(opened(path, passes)) {
  begin();
}

TraceFile::TraceFile(std::unique_ptr<std::istream> text, const std::string& name)
    : name_(name), own_(std::move(text)) {
  begin();
}

void TraceFile::begin() {
  std::vector<std::string> problems;
  try {
    reader_.emplace(own_ ? *own_ : std::cin, name_, &problems);
  } catch (const InputError&) {
    if (const std::string what = foreign_in(name_); !what.empty())
      throw InputError(name_, 1, 1, what);
    throw;
  }
  header_ = reader_->header();
  for (const std::string& doubt : reader_->doubts())
    std::cerr << name_ << ":" << reader_->line() << ":1: warning: " << doubt << '\n';
  try {
    checks_.emplace(header_, name_ + ":" + std::to_string(reader_->line()) + ":1: ", problems);
    header_.impulses.reset();
  } catch (const TraceChecks::Wrong& wrong) {
    throw InputError(name_, reader_->line(), 1, wrong.text);
  }
}

std::optional<trace::Frame> TraceFile::next() {
  const int last_line = reader_->line();
  std::optional<trace::Frame> frame = reader_->next();
  try {
    if (frame) {
      ++frames_;
      if (!is_known_) checks_->frame(*frame);
      if (reader_->header().impulses) convert_impulses(*reader_->header().impulses, *frame);
    } else if (frames_ == 0) {
      throw TraceChecks::Wrong{kOnlyHeader};
    } else if (!is_known_) {
      is_known_ = true;
      if (header_.frames == 0) header_.frames = checks_->last_frame() + 1;
    }
  } catch (const TraceChecks::Wrong& wrong) {
    throw InputError(name_, frame ? frame->line : last_line, 1, printable(wrong.text));
  }
  return frame;
}

std::vector<trace::Frame> TraceFile::next(const trace::Parts& parts, Workers& workers) {
  constexpr std::size_t kMaxFrames = 256, kMaxBytes = 4 << 20;  // enough for all threads to be busy
  std::vector<trace::FrameText> texts;
  trace::FrameText text;
  for (std::size_t bytes = 0;
       texts.size() < kMaxFrames && bytes < kMaxBytes && reader_->take(text);) {
    bytes += text.text.size();
    texts.push_back(std::move(text));
  }
  if (texts.empty() && frames_ == 0) throw InputError(name_, reader_->line(), 1, kOnlyHeader);
  std::vector<trace::Frame> frames = reader_->read(texts, parts, workers);
  frames_ += static_cast<int>(frames.size());
  for (trace::Frame& frame : frames) {
    try {
      checks_->shapes(frame);
    } catch (const TraceChecks::Wrong& wrong) {
      throw InputError(name_, frame.line, 1, printable(wrong.text));
    }
  }
  if (reader_->header().impulses)
    for (trace::Frame& frame : frames) convert_impulses(*reader_->header().impulses, frame);
  return frames;
}

void TraceFile::rewind() {
  reader_->rewind();
  frames_ = 0;
}

void TraceFile::report_torn() const {
  if (!torn()) return;
  std::cerr << InputError(
                   name_, torn()->line, torn()->column,
                   "the file is cut off here, within its last line; the lines before it are used. "
                   "The process that wrote it crashed, or is still writing")
                   .what()
            << '\n';
}

trace::Trace load_trace(const std::string& path) {
  TraceFile file(path);
  trace::Trace trace = read_whole(file);
  file.report_torn();
  return trace;
}

trace::Trace parse_trace(const std::string& text, const std::string& name) {
  TraceFile file(std::make_unique<std::istringstream>(text), name);
  return read_whole(file);
}

}  // namespace contactscope::app
