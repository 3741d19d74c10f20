#include "view/trough_motion.hpp"

#include "core/atomic_file.hpp"
#include "view/text_cursor.hpp"

namespace vibrotrough::view {

std::vector<TroughPosition> read_trough_motion(std::filesystem::path const& path) {
    std::string const text = read_file(path);
    std::vector<TroughPosition> positions;
    TextCursor cursor(text, path);
    try {
        TextCursor line = cursor;
        while (cursor.line().starts_with('#')) line = cursor;
        if (TextCursor(line).line() != "step,trough_x,trough_z")
            line.refuse("should be 'step,trough_x,trough_z'");
        while (!cursor.at_end()) {
            line = cursor;
            if (TextCursor(line).line().starts_with('#')) {
                cursor.line();
                continue;
            }
            TroughPosition position{};
            position.step = cursor.number<long>();
            cursor.comma();
            position.x = cursor.number<double>();
            cursor.comma();
            position.z = cursor.number<double>();
            cursor.end_line();
            if (!positions.empty() && position.step <= positions.back().step) {
                line.refuse("has a step that is not after the one before");
            }
            positions.push_back(position);
        }
    } catch (TextEnds const&) {
        return positions;
    }
    return positions;
}

}  // namespace vibrotrough::view
