#include "view/trough_motion.hpp"

#include "core/atomic_file.hpp"
#include "view/text_cursor.hpp"

#include <cmath>

namespace vibrotrough::view {

TroughState trough_state(FrameSource const& source, double time) {
    double const angle = source.angular_frequency * time;
    TroughState state{};
    auto const add = [&](std::vector<scenario::DriveTerm> const& terms, double& place, double& speed) {
        for (scenario::DriveTerm const& term : terms) {
            place += term.amplitude * (std::sin(term.order * angle + term.phase) - std::sin(term.phase));
            speed += term.amplitude * term.order * source.angular_frequency *
                     std::cos(term.order * angle + term.phase);
        }
    };
    add(source.drive.along, state.x, state.vx);
    add(source.drive.normal, state.z, state.vz);
    return state;
}

std::vector<TroughPosition> read_trough_motion(std::filesystem::path const& path) {
    std::string const text = core::read_file(path);
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
                line.refuse("has a step that is not larger than the previous one");
            }
            positions.push_back(position);
        }
    } catch (TextEnds const&) {
        return positions;
    }
    return positions;
}

}  // namespace vibrotrough::view
