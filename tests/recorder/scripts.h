#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <ostream>
#include <string>

#include "support/temporary_folder.h"

namespace contactscope {

/// A language with a recorder of its own.
struct Language {
  std::string name;
  std::string program;  ///< runs a script
  std::string probe;    ///< shell command that succeeds if the program is there and new enough
  std::string ending;   ///< of the names of scripts
  std::string path;     ///< first lines of a script, so that it finds the recorder
  std::string begin;    ///< imports the recorder
};

inline Language python() {
  return {"Python",
          "python3 -B",
          "python3 -c 'import dataclasses'",
          ".py",
          "import sys\nsys.path.insert(0, '" CONTACTSCOPE_SOURCE_DIR "/src/recorder')\n",
          "from contactscope import Point, Recorder\n"};
}
inline Language java_script() {
  return {"JavaScript",
          "node",
          "node -e 'process.exit(parseInt(process.versions.node) < 18 ? 1 : 0)'",
          ".mjs",
          "",
          "import { Recorder } from '" CONTACTSCOPE_SOURCE_DIR
          "/src/recorder/contactscope.mjs';\n"};
}

inline void PrintTo(const Language& language, std::ostream* out) { *out << language.name; }

/// Each test runs in each language.
class Scripts : public ::testing::TestWithParam<Language> {
 protected:
  void SetUp() override {
    if (std::system((GetParam().probe + " > /dev/null 2>&1").c_str()) != 0)
      GTEST_SKIP() << GetParam().program << " is not installed, or too old";
  }

  /// Runs a script in `folder_`, and returns the text that it prints.
  std::string output_of(const std::string& script) const {
    return printed_by(
        folder_.write("script" + GetParam().ending, GetParam().path + GetParam().begin + script));
  }
  std::string printed_by(const std::string& file) const {
    const std::string said = folder_ / "said";
    const std::string command = "cd '" + folder_.path().string() + "' && " + GetParam().program +
                                " '" + file + "' > '" + said + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_text(said);
    return read_text(said);
  }
  bool is_python() const { return GetParam().ending == ".py"; }

  TemporaryFolder folder_;
};

inline std::string name_of(const ::testing::TestParamInfo<Language>& info) {
  return info.param.name;
}

}  // namespace contactscope
