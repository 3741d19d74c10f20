#pragma once

#include <string>

namespace vibrotrough::deck {

/// A flat floor at z = 0 over the whole periodic box as ASCII STL. The outermost nodes lie exactly on the box
/// faces (the same doubles as in the deck) and the triangles are nearly isosceles, with edges of about
/// `edge`: LIGGGHTS wants both (see README.md of this room).
std::string flat_trough_stl(double length, double width, double edge);

}  // namespace vibrotrough::deck
