#include "app/cli/check_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>

namespace contactscope::app {
namespace {

snapshot::Update parse_update(const std::string& text) {
  if (text == "never") return snapshot::Update::None;
  if (text == "failed") return snapshot::Update::Failed;
  if (text == "all") return snapshot::Update::All;
  throw UsageError("--update=" + text + " is not known; write --update, --update=all or nothing");
}

snapshot::Shard parse_shard(const std::string& text) {
  constexpr int kMax = 100000;
  int part = 0, of = 0, length = 0;
  const bool is_read = std::sscanf(text.c_str(), "%6d/%6d%n", &part, &of, &length) == 2;
  if (is_read && length == static_cast<int>(text.size()) && part >= 1 && part <= of && of <= kMax)
    return {part, of};
  throw UsageError("--shard '" + text + "' is no part; write K/N with 1 <= K <= N, as 2/5");
}

/// Validates the extra word of a file name.
void check_word(const Options& options) {
  const std::string& word = options.accept_as;
  if ((!word.empty() || !options.note.empty()) && !options.accept)
    throw UsageError("--as and --note say how --accept stores; add --accept");
  const bool is_plain =
      std::ranges::all_of(word, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!is_plain)
    throw UsageError("--as '" + word + "' is no word; write letters, digits and _, as osmesa");
  if (!options.note.empty() && !word.starts_with("bad_"))
    throw UsageError("--note goes with --as bad_WORD, which is known again by it");
}

}  // namespace

CLI::Option* add_check_option(CLI::App& verb, const std::string& name, Options& to,
                              CheckTexts& texts) {
  const auto value = [&](auto& target, const char* help) {
    return verb.add_option(name, target, help);
  };
  const auto flag = [&](bool& target, const char* help) {
    return verb.add_flag(name, target, help);
  };
  // A flag with optional value: `--update SCENARIO` does not take the scenario as its value.
  if (name == "--update")
    return verb.add_flag("--update{failed}", texts.update,
                         "Rewrite what failed, or with --update=all everything");
  if (name == "--write-missing")
    return flag(texts.write_missing, "Store what nothing is stored of, and touch nothing else");
  if (name == "--facts-only")
    return flag(to.facts_only, "Compare traces and expectations; draw nothing, open no OpenGL");
  if (name == "--accept")
    return flag(to.accept,
                "Store what the last report has, without running anything: names as "
                "hull/face_contact/frame_0012, folders, or patterns with *");
  if (name == "--as")
    return value(to.accept_as,
                 "Accept beside what is stored, under a word more: osmesa for that driver's "
                 "picture, bad_31 for a bug to be known again");
  if (name == "--note") return value(to.note, "What is known of it, as --as bad_31 has one");
  if (name == "--shard")
    return value(texts.shard,
                 "Only part K of N of all scenarios, as 2/5; merge puts them together");
  if (name == "--times")
    return value(to.times, "How long each scenario takes, of an earlier run: OUT/check/times.json");
  if (name == "--fresh")
    return flag(to.fresh, "Run also scenarios of which nothing changed since the last check");
  if (name == "--junit")
    return value(to.junit, "Write a JUnit XML file too, with pictures attached");
  if (name == "--markdown")
    return value(to.markdown, "Write a summary in Markdown too, with small pictures in it");
  if (name == "--github") return flag(to.github, "Print annotations for GitHub too, one a cause");
  if (name == "--list") return flag(to.list_only, "Print a line each instead of asking");
  if (name == "--from")
    return value(to.from,
                 "Do what a file says, {\"accept\": [...], \"reject\": [...]}, which report.html "
                 "saves; - is the standard input");
  if (name == "--pictures")
    return value(to.pictures, "How the terminal draws: blocks, sixel, kitty, none")
        ->capture_default_str()
        ->check(CLI::IsMember({"auto", "blocks", "sixel", "kitty", "none"}));
  return nullptr;
}

void finish_check(const CheckTexts& texts, Options& options) {
  options.update = parse_update(texts.update);
  if (texts.write_missing && options.update == snapshot::Update::None)
    options.update = snapshot::Update::Missing;
  check_word(options);
  if (!texts.shard.empty()) options.shard = parse_shard(texts.shard);
  if (!options.times.empty() && !options.shard)
    throw UsageError("--times says how to share out scenarios; add --shard K/N");
}

}  // namespace contactscope::app
