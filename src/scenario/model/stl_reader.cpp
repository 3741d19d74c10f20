#include "scenario/model/stl_reader.hpp"

#include "scenario/model/run_settings.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// A binary STL: 80 bytes, the number of triangles, and 50 bytes for each, a normal, three corners and two
/// bytes.
constexpr std::size_t binary_head = 84, binary_triangle = 50;

std::optional<std::size_t> count_of_binary(std::string_view content) {
    if (content.size() < binary_head) return {};
    std::uint32_t count = 0;
    std::memcpy(&count, content.data() + 80, sizeof count);
    if (content.size() != binary_head + binary_triangle * std::size_t{count}) return {};
    return count;
}

Solids read_binary(std::string_view content, std::size_t count) {
    static_assert(std::endian::native == std::endian::little);
    std::vector<Triangle> triangles(std::min(count, most_triangles + 1));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        std::array<float, 9> corners{};
        std::memcpy(corners.data(), content.data() + binary_head + binary_triangle * i + 12, sizeof corners);
        for (std::size_t k = 0; k < 9; ++k) triangles[i][k / 3][k % 3] = corners[k];
    }
    std::vector<std::size_t> part_of(triangles.size());
    return {std::move(triangles), {"trough"}, std::move(part_of), true};
}

std::string lower(std::string word) {
    std::ranges::transform(word, word.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
}

/// The number of the part that begins with the rest of this line, its name. Characters that no name in a
/// campaign file may have become '_'.
std::size_t begin_part(std::istringstream& text, std::vector<std::string>& parts) {
    constexpr std::size_t most_parts = 100, longest = 100;
    std::string name;
    std::getline(text, name);
    name.erase(0, name.find_first_not_of(" \t\r"));
    name.erase(std::min({name.size(), longest, name.find_last_not_of(" \t\r") + 1}));
    name = part_name(std::move(name));
    if (name.empty()) name = "unnamed";
    auto const known = std::ranges::find(parts, name);
    if (known != parts.end()) return static_cast<std::size_t>(known - parts.begin());
    if (parts.size() == most_parts)
        throw std::invalid_argument(fmt::format("it has more than {} solids", most_parts));
    parts.push_back(std::move(name));
    return parts.size() - 1;
}

/// Solids without triangles are none.
void drop_empty_parts(Solids& solids) {
    std::vector<std::string> kept;
    std::vector<std::size_t> number(solids.parts.size());
    for (std::size_t part = 0; part < solids.parts.size(); ++part) {
        number[part] = kept.size();
        if (std::ranges::count(solids.part_of, part) > 0) kept.push_back(solids.parts[part]);
    }
    for (std::size_t& part : solids.part_of) part = number[part];
    solids.parts = std::move(kept);
}

/// A coordinate of this triangle (from 1).
double read_number(std::istringstream& text, std::size_t triangle) {
    std::string word;
    double value = 0;
    if (!(text >> word))
        throw std::invalid_argument(
            fmt::format("it ends within triangle {}, so that a part of it is missing", triangle));
    if (word.find(',') != std::string::npos)
        throw std::invalid_argument(
            fmt::format("triangle {} has decimal commas ({}), but an STL has decimal points", triangle,
                        word.substr(0, 30)));
    std::istringstream number(word);
    number.imbue(std::locale::classic());
    if (!(number >> value) || !number.eof())
        throw std::invalid_argument(fmt::format("a corner of triangle {} is not three numbers", triangle));
    return value;
}

/// @throws std::invalid_argument when the size of a binary file is not that of the triangles it announces
void refuse_wrong_count(std::string_view content) {
    if (content.size() < binary_head || content.find('\0') == std::string_view::npos) return;
    std::uint32_t count = 0;
    std::memcpy(&count, content.data() + 80, sizeof count);
    throw std::invalid_argument(fmt::format(
        "it is a binary STL of {} triangles by its header, but it has room for {:.4g}; a part of it may be "
        "missing",
        count, static_cast<double>(content.size() - binary_head) / binary_triangle));
}

Solids read_text(std::string_view content) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (content.starts_with(byte_order_mark)) content.remove_prefix(byte_order_mark.size());
    std::istringstream text{std::string(content)};
    text.imbue(std::locale::classic());
    Solids solids{};
    std::vector<Triangle>& triangles = solids.triangles;
    std::string word;
    if (!(text >> word) || lower(word) != "solid")
        throw std::invalid_argument("it is neither a text nor a binary STL");
    std::size_t part = begin_part(text, solids.parts), corner = 0;
    bool is_whole = true, is_ended = true;
    Triangle triangle{};
    while (text >> word && triangles.size() <= most_triangles) {
        word = lower(word);
        if (word == "endsolid" || word == "end") {
            is_ended = true;
            std::getline(text, word);
        }
        if (word == "endfacet" || is_ended) is_whole = true;
        if (word == "solid") part = begin_part(text, solids.parts);
        if (word != "vertex") continue;
        is_whole = is_ended = false;
        for (double& number : triangle[corner]) number = read_number(text, triangles.size() + 1);
        corner = (corner + 1) % 3;
        if (corner != 0) continue;
        triangles.push_back(triangle);
        solids.part_of.push_back(part);
    }
    if (corner != 0) throw std::invalid_argument("its last triangle has fewer than three corners");
    if (!is_whole)
        throw std::invalid_argument(
            fmt::format("it ends within triangle {}, so that a part of it is missing", triangles.size()));
    if (!is_ended) throw std::invalid_argument("it ends without a line 'endsolid': the file was cut");
    drop_empty_parts(solids);
    return solids;
}

}  // namespace

std::string part_name(std::string text) {
    for (char& c : text)
        if (!is_plain_text({&c, 1})) c = '_';
    return text;
}

Solids read_stl(std::string_view content) {
    auto const binary = count_of_binary(content);
    if (binary) return read_binary(content, *binary);
    refuse_wrong_count(content);
    return read_text(content);
}

}  // namespace vibrotrough::scenario
