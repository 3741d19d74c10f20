#pragma once

#include <charconv>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

namespace vibrotrough::view {

/// Thrown when the text ends before an item is complete, as in a file that is still being written.
struct TextEnds {};

/// Reads the numbers and lines written by the engine without copying them.
class TextCursor {
  public:
    /// `path` is named in error messages.
    TextCursor(std::string_view text, std::filesystem::path const& path)
        : at_(text.data()), end_(text.data() + text.size()), path_(&path) {}

    /// Everything was read.
    bool at_end() const { return at_ == end_; }

    /// Returns the rest of the line without its end. @throws TextEnds if the line end is missing
    std::string_view line();

    /// Reads a number up to the next space, comma or line end. @throws InputError if it is not a finite
    /// number
    /// @throws TextEnds if the text ends within it
    template <typename Number>
    Number number() {
        skip_spaces();
        Number value{};
        auto const [after, failure] = std::from_chars(at_, end_, value);
        if (after == end_) throw TextEnds{};
        if (failure != std::errc{} || !ends_a_value(*after)) refuse("is not a number");
        if constexpr (!std::is_integral_v<Number>) {
            if (!std::isfinite(value)) refuse("is not finite");
        }
        at_ = after;
        return value;
    }

    /// Passes over spaces and a line end. @throws InputError when there is more on the line
    void end_line();

    /// Reports an error at the current position. @throws InputError "file:line: 'rest of the line' <what>"
    [[noreturn]] void refuse(std::string_view what) const;

  private:
    static bool ends_a_value(char c) { return c == ' ' || c == '\n'; }
    void skip_spaces() {
        while (at_ != end_ && *at_ == ' ') ++at_;
    }

    char const* at_;
    char const* end_;
    std::filesystem::path const* path_;
    long line_ = 1;
};

}  // namespace vibrotrough::view
