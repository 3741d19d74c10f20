#include "core/text.hpp"

#include <algorithm>

namespace vibrotrough::core {

std::string printable(std::string_view text, std::size_t longest) {
    std::string line(text.substr(0, longest));
    std::ranges::replace_if(
        line, [](unsigned char c) { return c < ' ' || c > 126; }, '?');
    return text.size() > longest ? line + "..." : line;
}

}  // namespace vibrotrough::core
