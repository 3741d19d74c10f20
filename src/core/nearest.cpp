#include "core/nearest.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace vibrotrough::core {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t const substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row.back();
}

std::string_view nearest_word(std::string_view misspelt, std::span<std::string_view const> words) {
    constexpr std::size_t longest = 64, most_slips = 3;
    if (misspelt.size() > longest) return {};
    std::string_view nearest;
    std::size_t least = std::min(most_slips, misspelt.size() / 3) + 1;
    for (std::string_view const word : words) {
        std::size_t const distance = edit_distance(misspelt, word);
        if (distance < least) {
            least = distance;
            nearest = word;
        }
    }
    return nearest;
}

}  // namespace vibrotrough::core
