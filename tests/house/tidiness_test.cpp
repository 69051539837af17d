#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "house/include_order.h"

namespace contactscope::house {
namespace {

using testing::ElementsAreArray;
using testing::IsEmpty;

const std::string kRoot = CONTACTSCOPE_SOURCE_DIR;

/// Standard output of a shell command that runs in the repository; fails the test on a bad exit.
std::string shell(const std::string& command) {
  FILE* pipe = popen(("cd '" + kRoot + "' && " + command).c_str(), "r");
  if (!pipe) {
    ADD_FAILURE() << "cannot run: " << command;
    return {};
  }
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.append(buffer.data(), count);
  }
  const int status = pclose(pipe);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << command;
  return output;
}

/// Lines of packages.txt that are neither blank nor a comment.
std::vector<std::string> package_lines() {
  std::ifstream file(kRoot + "/packages.txt");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.front() != '#') lines.push_back(line);
  }
  return lines;
}

TEST(Tidiness, PackagesStandOneALine) {
  const std::vector<std::string> lines = package_lines();
  ASSERT_FALSE(lines.empty());
  // Debian policy 5.6.1
  constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyz0123456789+.-";
  std::set<std::string> seen;
  for (const std::string& line : lines) {
    // A question mark after a package means that a distribution may lack it.
    const std::string name = line.ends_with('?') ? line.substr(0, line.size() - 1) : line;
    EXPECT_EQ(name.find_first_not_of(kLetters), std::string::npos) << line;
    EXPECT_TRUE(seen.insert(line).second) << line << " is listed twice";
  }
}

TEST(Tidiness, SetupReadsThePackagesThatAreListed) {
  const std::string output =
      shell("eval \"$(grep '^wanted=' setup)\" && printf '%s\\n' $wanted && sh -n setup");
  std::istringstream words(output);
  std::vector<std::string> wanted;
  for (std::string word; words >> word;) wanted.push_back(word);
  EXPECT_THAT(wanted, ElementsAreArray(package_lines()));
}

TEST(Tidiness, SetupCanBeExecuted) {
  const std::filesystem::perms permissions =
      std::filesystem::status(kRoot + "/setup").permissions();
  EXPECT_NE(permissions & std::filesystem::perms::owner_exec, std::filesystem::perms::none);
}

std::vector<std::string> long_files(const std::vector<SourceFile>& files, long limit) {
  std::vector<std::string> found;
  for (const SourceFile& file : files) {
    const long lines = std::count(file.text.begin(), file.text.end(), '\n');
    if (lines > limit) found.push_back(file.path + " has " + std::to_string(lines) + " lines");
  }
  return found;
}

constexpr long kMaxLines = 450;  // around 300, look for a seam

TEST(Tidiness, NoFileIsLong) {
  std::vector<SourceFile> files = read_house(kRoot);
  // A recorder is one file so that it is easy to drop in, and so is a program in Python.
  std::erase_if(files, [](const SourceFile& file) {
    return file.path.starts_with("src/recorder/contactscope.") ||
           file.path == "src/scenario/import/contactscope-import";
  });
  EXPECT_THAT(long_files(files, kMaxLines), IsEmpty());
}

TEST(Tidiness, ALongFileIsCaught) {
  EXPECT_THAT(long_files({{"src/core/a.h", std::string(450, '\n')},
                          {"src/core/b.h", std::string(451, '\n')}},
                         kMaxLines),
              testing::ElementsAre("src/core/b.h has 451 lines"));
}

}  // namespace
}  // namespace contactscope::house
