#include "snapshot/compare_trace.h"

#include <algorithm>
#include <cstddef>
#include <sstream>

#include "snapshot/compare_frames.h"
#include "snapshot/first_cause.h"
#include "snapshot/store.h"

namespace contactscope::snapshot {
namespace {

using trace::Trace;

/// Adds the sentences of the header or of one frame.
void report(const std::string& place, const std::vector<Difference>& differences,
            std::vector<std::string>& sentences) {
  for (std::size_t i = 0; i < differences.size() && i < kMaxSentences; ++i) {
    const auto& [subject, text, stage, what] = differences[i];
    sentences.push_back(place + (subject.empty() ? "" : ", " + subject) + ": " + text);
  }
  if (differences.size() > kMaxSentences) {
    sentences.push_back(place + ": and " + std::to_string(differences.size() - kMaxSentences) +
                        " more");
  }
}

/// Settles `actual`; see Changes.
TraceDifferences compare_and_settle(const Trace& expected, Trace& actual,
                                    const Margins& margins = {}) {
  TraceDifferences record;
  std::vector<FrameDifferences> all;
  const std::string name = actual.header.scenario;
  const FrameComparison comparison(expected.header);
  std::vector<Difference> header = comparison.header(expected.header, actual.header);

  const auto number = [](const trace::Frame& frame) {
    return "frame " + std::to_string(frame.frame);
  };
  const auto numbers = [&](const std::vector<trace::Frame>& frames) {
    std::vector<std::string> keys;
    for (const trace::Frame& frame : frames) keys.push_back(number(frame));
    return keys;
  };
  const Match match = match_keys(numbers(expected.frames), numbers(actual.frames));
  for (const std::size_t i : match.gone)
    header.push_back({number(expected.frames[i]), "gone", Stage::Frames});
  for (const std::size_t i : match.added)
    header.push_back({number(actual.frames[i]), "added", Stage::Frames});
  if (match.reordered()) header.push_back({"", "frames in another order", Stage::Frames});
  report(name, header, record.sentences);
  for (const Difference& difference : header) {
    record.is_words = record.is_words || difference.stage == Stage::Words;
    record.is_setup = record.is_setup || difference.stage == Stage::Setup;
  }
  if (!header.empty()) all.push_back({-1, nullptr, nullptr, std::move(header)});

  for (const auto& [i, j] : match.both) {
    const trace::Frame& frame = expected.frames[i];
    std::vector<Difference> differences = comparison.frame(frame, actual.frames[j]);
    report(name + " " + number(frame), differences, record.sentences);
    if (differences.empty()) continue;
    record.frames.push_back(frame.frame);
    all.push_back({frame.frame, &frame, &actual.frames[j], std::move(differences)});
  }
  if (!all.empty()) {
    FirstCause cause = first_cause(name, all, margins);
    record.cause = std::move(cause.sentence);
    record.signature = std::move(cause.signature);
    record.is_input = cause.is_input;
  }
  return record;
}

/// Characters around a position of a line.
std::string about(const std::string& line, std::size_t at) {
  constexpr std::size_t kBefore = 24, kLength = 48;
  return at < line.size() ? line.substr(at - std::min(at, kBefore), kLength) : "(the end)";
}

}  // namespace

std::vector<std::string> compare_traces(const Trace& expected, const Trace& actual) {
  Trace settled = actual;
  return compare_and_settle(expected, settled).sentences;
}

TraceDifferences compare_with_stored(const std::string& text, const std::string& path,
                                     const Trace& actual, const Margins& margins) {
  std::istringstream stored(text);
  Trace settled = actual;
  const Trace expected = trace::read_trace(stored, path);
  TraceDifferences record = compare_and_settle(expected, settled, margins);
  if (!record.sentences.empty()) return record;
  const std::string written = to_json_lines(settled);
  const auto [at, other] = std::ranges::mismatch(text, written);
  if (at == text.end() && other == written.end()) return {};
  const auto line_of = [](const std::string& all, std::size_t begin) {
    return all.substr(begin, all.find('\n', begin) - begin);
  };
  const auto place = static_cast<std::size_t>(at - text.begin());
  const std::size_t begin = place == 0 ? 0 : text.rfind('\n', place - 1) + 1;
  const auto line = std::count(text.begin(), at, '\n');
  record.cause = actual.header.scenario + ": line " + std::to_string(line + 1) + " of " + path +
                 " is written differently, though no fact in it differs: it has '" +
                 about(line_of(text, begin), place - begin) + "' instead of '" +
                 about(line_of(written, begin), place - begin) + "'";
  record.sentences = {record.cause};
  record.signature = "bytes";
  return record;
}

}  // namespace contactscope::snapshot
