#include "app/render/formats/sinks.h"

#include "app/cli/faults.h"
#include "app/render/figure_canvas.h"
#include "snapshot/store.h"
#include "vector/pieces.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

/// Completes the command for one file: with the option for its frames (or "") and its format.
PictureOrigin completed(PictureOrigin origin, const std::string& frames, const Format& format) {
  origin.command += frames;
  if (&format != &formats().front()) origin.command += " --format " + std::string(format.name);
  return origin;
}

}  // namespace

Sinks::Sinks(std::vector<const Format*> formats, const Options& options, Renderer& renderer)
    : formats_(std::move(formats)),
      options_(options),
      renderer_(renderer),
      needs_pixels_(std::ranges::any_of(formats_, &Format::needs_pixels)),
      encoders_(options.jobs) {}

int Sinks::files() const {
  int count = 0;
  for (const auto& [scenario, paths] : written_) count += count_of(paths);
  return count;
}

bool Sinks::needs_drawings() const {
  return options_.anchors || std::ranges::any_of(formats_, &Format::needs_drawings);
}

bool Sinks::needs_stages() const { return !std::ranges::all_of(formats_, &Format::needs_drawings); }

std::string Sinks::path_of(const std::string& scenario, const fs::path& stem,
                           std::string_view extension) {
  const std::string path = stem.string() + std::string(extension);
  fs::create_directories(stem.parent_path());
  if (written_.empty() || written_.back().first != scenario)
    written_.emplace_back(scenario, std::vector<std::string>());
  written_.back().second.push_back(path);
  return path;
}

void Sinks::begin(const Series& series) {
  series_ = series;
  if (needs_pixels_) renderer_.open(series.staging->layout.width, series.staging->layout.height);
  const bool is_one = series.frames.size() == 1;
  const fs::path folder = snapshot::picture_folder(options_.out, series.scenario, series.view);
  const std::string stem = is_one ? snapshot::frame_stem(series.frames.front()) : "sequence";
  reels_.clear();
  for (const Format* format : formats_) {
    reels_.emplace_back();
    if (format->begin == nullptr || (is_one && format->encode != nullptr)) continue;
    ReelPlan plan{path_of(series.scenario, folder / stem, format->extension),
                  completed(series.origin, frames_option(options_), *format),
                  series.staging,
                  series.sequence,
                  series.frames,
                  options_.fps};
    plan.origin.frames = separated(series.frames, ", ");
    plan.to_lint = linter_options(options_);
    plan.to_lint.ids_are_made = series.sequence->ids_are_made;
    plan.is_known = [known = KnownFindings(options_), file = series.sequence->path](
                        lint::Finding& finding) { return known.knows(file, finding); };
    reels_.back() = format->begin(plan);
  }
}

Shot Sinks::shot_of(draw::Drawing drawing) {
  Shot shot{std::make_shared<const draw::Drawing>(std::move(drawing))};
  if (needs_pixels_) shot.image = std::make_shared<const Image>(renderer_.paint(*shot.drawing));
  return shot;
}

void Sinks::encode(const Format& format, const std::string& path, const Shot& shot) {
  encoders_.submit([&format, path, shot] { write_whole_file(path, format.encode(shot)); });
}

void Sinks::add(const trace::Frame& frame, draw::Drawing drawing) {
  const fs::path folder = snapshot::picture_folder(options_.out, series_.scenario, series_.view);
  if (options_.anchors) {
    snapshot::write_text(
        path_of(series_.scenario, folder / snapshot::frame_stem(frame.frame), ".anchors.json"),
        vector::anchors_of(*series_.staging, frame, drawing));
  }
  Shot shot = shot_of(std::move(drawing));
  for (std::size_t i = 0; i < formats_.size(); ++i) {
    const Format& format = *formats_[i];
    shot.origin = completed(series_.origin, " --frames " + std::to_string(frame.frame), format);
    shot.origin.frame = frame.frame;
    shot.origin.title = draw::fill_title(*series_.staging, frame);
    if (reels_[i])
      reels_[i]->add(shot, frame);
    else
      encode(
          format,
          path_of(series_.scenario, folder / snapshot::frame_stem(frame.frame), format.extension),
          shot);
  }
}

void Sinks::end() {
  for (const auto& reel : reels_)
    if (reel) reel->finish();
  reels_.clear();
}

void Sinks::add_alone(const std::string& stem, const std::string& scenario,
                      const PictureOrigin& origin, draw::Drawing drawing) {
  if (needs_pixels_) renderer_.open(drawing.width, drawing.height);
  Shot shot = shot_of(std::move(drawing));
  for (const Format* format : formats_) {
    shot.origin = completed(origin, "", *format);
    encode(*format, path_of(scenario, fs::path(options_.out) / stem, format->extension), shot);
  }
}

}  // namespace contactscope::app
