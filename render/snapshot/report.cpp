#include "snapshot/report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "image/compare.h"
#include "image/png.h"

namespace contactscope::snapshot {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kExpected = ".expected.png", kActual = ".actual.png",
                           kDifference = ".difference.png";
constexpr std::string_view kText = "report.txt", kIndex = "index.html";

bool is_ours(const std::string& name) {
  return name == kText || name == kIndex || name.ends_with(kExpected) || name.ends_with(kActual) ||
         name.ends_with(kDifference);
}

void remove_old_report(const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> files, folders;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) folders.push_back(entry.path());
    if (is_ours(entry.path().filename().string())) files.push_back(entry.path());
  }
  for (const fs::path& file : files) fs::remove(file);
  // Folders that hold nothing else go as well, the deepest first.
  std::sort(folders.rbegin(), folders.rend());
  for (const fs::path& empty : folders) {
    std::error_code not_empty;
    fs::remove(empty, not_empty);
  }
}

constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>contactscope check</title>
<style>
body { font: 16px/1.4 sans-serif; margin: 24px; color: #222; }
h2 { margin-top: 40px; border-top: 1px solid #ccc; padding-top: 16px; }
figure { display: inline-block; width: 32%; margin: 0; vertical-align: top; }
img { width: 100%; border: 1px solid #ccc; }
li { font-variant-numeric: tabular-nums; }
</style>
)";

std::string figure(const std::string& caption, const std::string& path) {
  if (path.empty()) return "<figure>" + caption + ": none</figure>\n";
  const std::string url = escape_html(to_url(path));
  return "<figure>" + caption + "<a href=\"" + url + "\"><img src=\"" + url + "\" alt=\"" +
         caption + "\"></a></figure>\n";
}

}  // namespace

Report::Report(const fs::path& out) : folder_(out / "check") {
  remove_old_report(folder_);
}

void Report::add(const CheckedPicture& picture, const Image& actual) {
  if (!picture.fails) return;
  const PictureKey& key = picture.key;
  fs::create_directories(picture_folder(folder_, key.scenario, key.view));
  const std::string stem = picture_path(folder_, key).replace_extension().string();
  const auto write = [&](std::string_view ending, const Image& image) {
    const std::string path = stem + std::string(ending);
    write_png(path, image);
    return fs::path(path).lexically_relative(folder_).generic_string();
  };
  Pictures pictures;
  pictures.title = "frame " + std::to_string(key.frame);
  if (key.view) pictures.title += ", view " + *key.view;
  pictures.actual = write(kActual, actual);
  if (picture.expected) {
    pictures.expected = write(kExpected, *picture.expected);
    pictures.difference = write(kDifference, difference_image(*picture.expected, actual));
  }
  add(key.scenario, picture.sentences);
  scenarios_[key.scenario].pictures.push_back(std::move(pictures));
}

void Report::add(const Checked& file) {
  if (file.fails) add(file.scenario, file.sentences);
}

void Report::add(const std::string& scenario, const std::vector<std::string>& sentences) {
  ++failures_;
  std::vector<std::string>& all = scenarios_[scenario].sentences;
  all.insert(all.end(), sentences.begin(), sentences.end());
}

std::optional<fs::path> Report::finish() const {
  if (failures_ == 0) return {};
  for (const auto& [scenario, failures] : scenarios_) {
    std::string text;
    for (const std::string& sentence : failures.sentences) text += sentence + "\n";
    write_text(scenario_folder(folder_, scenario) / kText, text);
  }
  const fs::path index = folder_ / kIndex;
  write_text(index, html());
  return index;
}

std::string Report::html() const {
  std::string text = kHead;
  text += "<h1>" + std::to_string(scenarios_.size()) +
          (scenarios_.size() == 1 ? " scenario fails" : " scenarios fail") + "</h1>\n";
  for (const auto& [scenario, failures] : scenarios_) {
    text += "<h2>" + escape_html(scenario) + "</h2>\n<ul>\n";
    for (const std::string& sentence : failures.sentences) {
      text += "<li>" + escape_html(sentence) + "</li>\n";
    }
    text += "</ul>\n";
    for (const Pictures& pictures : failures.pictures) {
      text += "<h3>" + escape_html(pictures.title) + "</h3>\n";
      text += figure("expected", pictures.expected);
      text += figure("actual", pictures.actual);
      text += figure("difference", pictures.difference);
    }
  }
  return text + "</html>\n";
}

std::string escape_html(const std::string& text) {
  constexpr std::pair<char, const char*> kEscapes[] = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  std::string escaped;
  for (const char c : text) {
    const auto found = std::ranges::find(kEscapes, c, &std::pair<char, const char*>::first);
    escaped += found == std::end(kEscapes) ? std::string(1, c) : found->second;
  }
  return escaped;
}

std::string to_url(const std::string& path) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string url;
  for (const char c : path) {
    if (kPlain.find(c) != std::string_view::npos) {
      url += c;
      continue;
    }
    std::array<char, 4> coded;
    std::snprintf(coded.data(), coded.size(), "%%%02X", static_cast<unsigned char>(c));
    url += coded.data();
  }
  return url;
}

}  // namespace contactscope::snapshot
