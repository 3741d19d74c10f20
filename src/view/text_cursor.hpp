#pragma once

#include <charconv>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

namespace vibrotrough::view {

/// The text ends before what is looked for is complete: a file that is still being written.
struct TextEnds {};

/// Walks through the engine's numbers and lines without copying them.
class TextCursor {
  public:
    /// `path` stands for the text in errors.
    TextCursor(std::string_view text, std::filesystem::path const& path)
        : at_(text.data()), end_(text.data() + text.size()), path_(&path) {}

    /// Everything was read.
    bool at_end() const { return at_ == end_; }

    /// The rest of the line, without its end. @throws TextEnds when it has none
    std::string_view line();

    /// Reads a number up to the next space, comma or line end. @throws InputError when it is none or not
    /// finite
    /// @throws TextEnds when the text stops within it
    template <typename Number>
    Number number() {
        skip_spaces();
        Number value{};
        auto const [after, failure] = std::from_chars(at_, end_, value);
        if (after == end_) throw TextEnds{};
        if (failure != std::errc{} || !ends_a_value(*after)) refuse("is no number");
        if constexpr (!std::is_integral_v<Number>) {
            if (!std::isfinite(value)) refuse("is not finite");
        }
        at_ = after;
        return value;
    }

    /// Passes over a comma. @throws InputError when there is none
    void comma();

    /// Passes over spaces and a line end. @throws InputError when there is more on the line
    void end_line();

    /// @throws InputError "file:line: 'rest of the line' <what>"
    [[noreturn]] void refuse(std::string_view what) const;

  private:
    static bool ends_a_value(char c) { return c == ' ' || c == '\n' || c == ','; }
    void skip_spaces() {
        while (at_ != end_ && *at_ == ' ') ++at_;
    }

    char const* at_;
    char const* end_;
    std::filesystem::path const* path_;
    long line_ = 1;
};

}  // namespace vibrotrough::view
