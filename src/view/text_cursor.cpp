#include "view/text_cursor.hpp"

#include "core/error.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::view {

std::string_view TextCursor::line() {
    char const* const stop = std::find(at_, end_, '\n');
    if (stop == end_) throw TextEnds{};
    std::string_view const found(at_, static_cast<std::size_t>(stop - at_));
    at_ = stop + 1;
    ++line_;
    return found;
}

void TextCursor::end_line() {
    skip_spaces();
    if (at_ == end_) throw TextEnds{};
    if (*at_ != '\n') refuse("does not belong on this line");
    ++at_;
    ++line_;
}

void TextCursor::refuse(std::string_view what) const {
    std::size_t constexpr shown = 40;
    char const* const stop = std::find(at_, at_ + std::min<std::ptrdiff_t>(shown, end_ - at_), '\n');
    throw core::InputError(fmt::format("{}:{}: '{}' {} (the file is damaged); run the case again",
                                       path_->string(), line_,
                                       std::string_view(at_, static_cast<std::size_t>(stop - at_)), what));
}

}  // namespace vibrotrough::view
