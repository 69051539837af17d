#include "app/compare/soak.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "app/cli/progress.h"
#include "app/cli/shard.h"
#include "app/cli/table.h"
#include "core/input_error.h"
#include "snapshot/store.h"
#include "trace/listed_json.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

constexpr int kCases = 100000;  // default of --cases
constexpr const char* kSoakSchema = "contactscope.soak/1";

std::string file_of(const snapshot::Shard& shard) {
  return "soak_" + std::to_string(shard.part) + "_of_" + std::to_string(shard.of) + ".json";
}

/// The file; `shard` is set for a part.
struct SoakFile {
  std::optional<snapshot::Shard> shard{};
  Soak soak{};

  static constexpr auto fields() {
    using namespace trace::field;
    return list(exact("shard", &SoakFile::shard), merged(&SoakFile::soak));
  }
};

std::string to_json(const SoakFile& file) {
  const trace::Json start = {{"schema", kSoakSchema}, {"study", "stability"}};
  return trace::written("soak", file, start).dump(1) + "\n";
}

SoakFile parse_soak(const std::string& text, const std::string& path) {
  try {
    const trace::Json json = trace::Json::parse(text);
    if (json.at("schema") != kSoakSchema)
      throw InputError(
          path, 0, 0,
          std::string("this is not a part of study stability: its schema is not ") + kSoakSchema);
    SoakFile file;
    trace::read_json(json, file);
    return file;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path, 0, 0,
                     std::string("this part of study stability cannot be read: ") + error.what() +
                         "; run its shard again");
  }
}

/// Sums over all kinds of pairs for each sweep and scalar.
std::vector<SoakLine> by_sweep(const Soak& soak) {
  std::vector<SoakLine> sums;
  for (const SoakLine& line : soak.lines) {
    const auto is_same = [&](const SoakLine& sum) {
      return sum.sweep == line.sweep && sum.scalar == line.scalar;
    };
    auto sum = std::ranges::find_if(sums, is_same);
    if (sum == sums.end()) {
      sums.push_back(line);
      continue;
    }
    sum->add(line);
  }
  std::ranges::stable_sort(sums, {}, &SoakLine::scalar);
  std::ranges::reverse(sums);
  return sums;
}

/// Bound in ulps, a power of two, on the errors of this share of the pairs without a fault.
std::string within(const SoakLine& line, double share) {
  std::int64_t all = line.exact, seen = line.exact;
  for (const auto& [exponent, count] : line.errors) all += count;
  const double wanted = share * static_cast<double>(all);
  if (static_cast<double>(seen) >= wanted) return all == 0 ? "-" : "0";
  for (const auto& [exponent, count] : line.errors) {
    seen += count;
    if (static_cast<double>(seen) >= wanted) return printed("%g", std::ldexp(1.0, exponent));
  }
  return "-";
}

ExitCode report(const Soak& soak, const std::string& file, const Options& options) {
  if (options.json) {
    std::cout << to_json({options.shard, soak});
  } else {
    Table table = {{"sweep", "scalar", "pairs", "wrong", "drowned", "half within (ulps)",
                    "99.9% within", "largest error"}};
    for (SoakLine& line : by_sweep(soak))
      table.push_back({line.sweep, line.scalar, std::to_string(line.pairs),
                       std::to_string(line.wrong()), std::to_string(line.faults["drowned"]),
                       within(line, 0.5), within(line, 0.999), printed("%.3g", line.worst_ulps)});
    print(table, std::cout);
    for (const SoakFailure& failure : soak.failures)
      std::cout << "case " << failure.number << ": " << failure.pair << " in " << failure.scalar
                << ", " << failure.sweep << " " << printed("%.3g", failure.value) << ": "
                << failure.fault << ", off by " << printed("%.3g", failure.ulps) << " ulps\n";
  }
  if (!options.quiet) {
    std::int64_t pairs = 0;
    for (const SoakLine& line : soak.lines) pairs += line.pairs;
    std::cerr << pairs << " pairs judged, " << soak.wrong() << " wrong; " << file << '\n';
  }
  return soak.wrong() == 0 ? ExitCode::Same : ExitCode::Different;
}

struct SoakPart {
  std::string from;  // file
  Soak soak;
  snapshot::Shard shard;
};

SoakPart read_part(const std::string& file) {
  const std::optional<std::string> text = snapshot::read_text_file(file);
  if (!text) throw InputError(file, 0, 0, "no such file");
  SoakFile read = parse_soak(*text, file);
  if (!read.shard) throw InputError(file, 0, 0, "this is a merged result, not a part of one");
  return {file, std::move(read.soak), *read.shard};
}

void require_one_run(const std::vector<SoakPart>& parts) {
  const SoakPart& first = parts.front();
  for (const SoakPart& part : parts) {
    if (part.shard.of != first.shard.of || part.soak.seed != first.soak.seed ||
        part.soak.cases != first.soak.cases || part.soak.lines.size() != first.soak.lines.size())
      throw UsageError(part.from + " and " + first.from +
                       " are parts of different runs; run all shards with one program and the same "
                       "--cases and --seed, each run with its own --out");
  }
  require_every_shard(parts);
}

}  // namespace

ExitCode run_soak(const Options& options) {
  const snapshot::Shard& shard = *options.shard;
  const std::int64_t cases = options.cases.value_or(kCases);
  const std::int64_t first = cases * (shard.part - 1) / shard.of,
                     last = cases * shard.part / shard.of;
  constexpr int kSteps = 100;
  Progress progress(kSteps, options.quiet);
  int record = 0;
  const Soak soak = soak_pairs(options.seed, cases, first, last, [&](std::int64_t done) {
    stop_if_interrupted();
    for (; record < kSteps * done / std::max<std::int64_t>(last - first, 1); ++record)
      progress.advance(std::to_string(done) + " pairs");
  });
  const std::string file = (fs::path(options.out) / file_of(shard)).generic_string();
  snapshot::write_text(file, to_json({shard, soak}));
  return report(soak, file, options);
}

std::vector<std::string> soak_parts(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  const auto is_part = [](const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("soak_") && name.ends_with(".json");
  };
  for (const std::string& name : names) {
    if (fs::is_regular_file(name) && is_part(name)) files.push_back(name);
    if (!fs::is_directory(name)) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(name))
      if (entry.is_regular_file() && is_part(entry.path()))
        files.push_back(entry.path().generic_string());
  }
  std::ranges::sort(files);
  return files;
}

ExitCode merge_soak(const std::vector<std::string>& files, const Options& options) {
  std::vector<SoakPart> parts;
  for (const std::string& file : files) parts.push_back(read_part(file));
  std::ranges::stable_sort(parts, {}, [](const SoakPart& part) { return part.shard.part; });
  require_one_run(parts);
  Soak whole = parts.front().soak;
  for (std::size_t i = 1; i < parts.size(); ++i) add(whole, parts[i].soak);
  const std::string file =
      (fs::path(options.out) / "study" / "stability" / "soak.json").generic_string();
  snapshot::write_text(file, to_json({{}, whole}));
  return report(whole, file, options);
}

}  // namespace contactscope::app
