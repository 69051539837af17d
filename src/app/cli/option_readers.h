#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/cli/options.h"

/// Readers of options whose text is more than a word or a number. Each throws UsageError, with the
/// name of the option and a remedy.
namespace contactscope::app {

/// Position of a word among those of an option. Throws UsageError with the nearest and all of them.
std::size_t word_in(const std::string& option, const std::string& text,
                    const std::vector<std::string_view>& known);

Size parse_size(const std::string& option, const std::string& text);
FrameRange parse_frames(const std::string& option, const std::string& text);
/// Metres; 0: fitted.
double parse_orthographic(const std::string& option, const std::string& text);
/// `option` may also be the environment variable that has the text.
gl::Backend parse_backend(const std::string& option, const std::string& text);
snapshot::Update parse_update(const std::string& option, const std::string& text);
snapshot::Shard parse_shard(const std::string& option, const std::string& text);
/// "none" alone is an empty list.
std::vector<Layer> parse_layers(const std::string& option, const std::string& text);
std::vector<Panel> parse_panels(const std::string& option, const std::string& text);
FigureLength parse_length(const std::string& option, const std::string& text);
draw::Color parse_background(const std::string& option, const std::string& text);
draw::Theme parse_theme(const std::string& option, const std::string& text);

/// A reader that parses into a member of Options.
template <auto kMember, auto kParse>
void read(Options& to, const std::string& option, const std::string& text) {
  to.*kMember = kParse(option, text);
}

}  // namespace contactscope::app
