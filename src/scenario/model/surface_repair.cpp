#include "scenario/model/surface_repair.hpp"

#include "scenario/model/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

using Corners = std::array<std::size_t, 3>;  ///< of a triangle, as numbers of nodes
using Edge = std::array<std::size_t, 2>;     ///< numbers of its nodes, the lower one first

Point middle(Point const& a, Point const& b) {
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

Edge edge_of(Corners const& corners, std::size_t k) {
    return {std::min(corners[k], corners[(k + 1) % 3]), std::max(corners[k], corners[(k + 1) % 3])};
}

/// Triangles that share nodes.
struct Net {
    std::vector<Point> nodes;
    std::vector<Corners> triangles;

    Triangle at(Corners const& c) const { return {nodes[c[0]], nodes[c[1]], nodes[c[2]]}; }

    /// The triangles at each edge.
    std::map<Edge, std::vector<std::size_t>> edges() const {
        std::map<Edge, std::vector<std::size_t>> all;
        for (std::size_t i = 0; i < triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) all[edge_of(triangles[i], k)].push_back(i);
        return all;
    }
};

/// @param joined  receives the corners that were moved
Net net_of(std::vector<Triangle> const& triangles, double tolerance, std::vector<Point>& joined) {
    Net net;
    std::vector<Point const*> corners;
    for (Triangle const& triangle : triangles)
        for (Point const& corner : triangle) corners.push_back(&corner);
    std::vector<std::size_t> order(corners.size()), node(corners.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return *corners[i]; });
    for (std::size_t const i : order) {
        std::size_t n = net.nodes.size();
        while (n > 0 && (*corners[i])[0] - net.nodes[n - 1][0] <= tolerance &&
               length(minus(*corners[i], net.nodes[n - 1])) > tolerance)
            --n;
        bool const is_known = n > 0 && (*corners[i])[0] - net.nodes[n - 1][0] <= tolerance;
        if (is_known && *corners[i] != net.nodes[n - 1]) joined.push_back(*corners[i]);
        if (!is_known) net.nodes.push_back(*corners[i]);
        node[i] = is_known ? n - 1 : net.nodes.size() - 1;
    }
    for (std::size_t i = 0; i < triangles.size(); ++i)
        net.triangles.push_back({node[3 * i], node[3 * i + 1], node[3 * i + 2]});
    return net;
}

/// Mends a surface as mend() says.
class Mending {
  public:
    Mending(Surface& surface, double tolerance, Point const& origin)
        : surface_(surface), tolerance_(tolerance), origin_(origin) {}

    std::vector<std::string> do_it() {
        std::vector<Point> joined;
        net_ = net_of(surface_.triangles, tolerance_, joined);
        if (!joined.empty())
            say(joined.size(),
                {"corner was joined with another that is closer than {}",
                 "corners were joined with others that are closer than {}"},
                joined.front());
        leave_out({"triangle without area was left out", "triangles without area were left out"},
                  [&](std::size_t i) { return is_flat(i); });
        std::set<Corners> known;
        leave_out({"copy of a triangle was left out", "copies of triangles were left out"},
                  [&](std::size_t i) {
                      Corners nodes = net_.triangles[i];
                      std::ranges::sort(nodes);
                      return !known.insert(nodes).second;
                  });
        divide_at_nodes();
        for (std::size_t i = 0; i < net_.triangles.size(); ++i)
            surface_.triangles[i] = net_.at(net_.triangles[i]);
        return said_;
    }

  private:
    /// What was done at one place, and at several.
    struct Done {
        char const *once, *often;
    };

    void say(std::size_t count, Done const& what, Point const& at, std::string const& which = "") {
        Point place{};
        for (std::size_t k = 0; k < 3; ++k) place[k] = at[k] + origin_[k];
        said_.push_back(fmt::format(
            "{} {}: {}at ({:.6g}, {:.6g}, {:.6g}) in the file{}", count,
            fmt::format(fmt::runtime(count > 1 ? what.often : what.once), fmt::format("{:.2g}", tolerance_)),
            which, place[0], place[1], place[2], count > 1 ? ", for example" : ""));
    }

    bool is_flat(std::size_t i) const {
        Triangle const t = net_.at(net_.triangles[i]);
        return length(area(t)) <= tolerance_ * longest_edge(t);
    }

    template <typename IsWrong>
    void leave_out(Done const& what, IsWrong const& is_wrong) {
        std::size_t kept = 0, first = 0;
        Point place{};
        std::size_t const before = net_.triangles.size();
        for (std::size_t i = 0; i < before; ++i) {
            if (is_wrong(i)) {
                if (first == 0) place = surface_.triangles[i][0];
                if (first == 0) first = surface_.numbers[i];
                continue;
            }
            net_.triangles[kept] = net_.triangles[i];
            surface_.triangles[kept] = surface_.triangles[i];
            surface_.part_of[kept] = surface_.part_of[i];
            surface_.numbers[kept++] = surface_.numbers[i];
        }
        if (kept == before) return;
        resize(kept);
        say(before - kept, what, place, fmt::format("triangle {} ", first));
    }

    void resize(std::size_t count) {
        net_.triangles.resize(count);
        surface_.triangles.resize(count);
        surface_.part_of.resize(count);
        surface_.numbers.resize(count);
    }

    /// The nodes inside of an edge.
    bool is_inside(Edge const& edge, std::size_t node) const {
        if (node == edge[0] || node == edge[1]) return false;
        Point const along = minus(net_.nodes[edge[1]], net_.nodes[edge[0]]),
                    to = minus(net_.nodes[node], net_.nodes[edge[0]]);
        double const size = length(along), at = dot(along, to) / size;
        return at > tolerance_ && at < size - tolerance_ && length(cross(along, to)) <= tolerance_ * size;
    }

    void divide_at_nodes() {
        std::set<std::size_t> nodes;
        std::vector<std::pair<Edge, std::size_t>> border;
        for (auto const& [edge, at] : net_.edges()) {
            if (at.size() != 1) continue;
            nodes.insert(edge.begin(), edge.end());
            border.emplace_back(edge, at.front());
        }
        std::size_t count = 0, first = 0;
        for (std::size_t i = 0; i < border.size(); ++i) {
            auto const [edge, triangle] = border[i];
            auto const found = std::ranges::find_if(nodes, [&](std::size_t n) { return is_inside(edge, n); });
            if (found == nodes.end()) continue;
            if (count++ == 0) first = *found;
            divide(triangle, edge, *found, border);
        }
        if (count > 0)
            say(count,
                {"edge was divided where a corner lies in it",
                 "edges were divided where a corner lies in them"},
                net_.nodes[first]);
    }

    /// Divides a triangle at a node in one of its edges. Borders of the part that is new belong to it.
    void divide(std::size_t triangle, Edge const& edge, std::size_t node,
                std::vector<std::pair<Edge, std::size_t>>& border) {
        Corners corners = net_.triangles[triangle];
        std::size_t k = 0;
        while (edge_of(corners, k) != edge) ++k;
        std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k), corners.end());
        std::size_t const added = net_.triangles.size();
        net_.triangles[triangle] = {corners[0], node, corners[2]};
        resize(added + 1);
        net_.triangles[added] = {node, corners[1], corners[2]};
        surface_.part_of[added] = surface_.part_of[triangle];
        surface_.numbers[added] = surface_.numbers[triangle];
        Edge const moved = edge_of(corners, 1);
        for (auto& [one, of] : border)
            if (of == triangle && one == moved) of = added;
        border.emplace_back(edge_of(net_.triangles[triangle], 0), triangle);
        border.emplace_back(edge_of(net_.triangles[added], 0), added);
    }

    Surface& surface_;
    double tolerance_;
    Point origin_;
    Net net_;
    std::vector<std::string> said_;
};

/// The corner of a triangle that does not belong to an edge, and the corners of the edge in its order.
Corners seen_from(Corners corners, Edge const& edge) {
    std::size_t k = 0;
    while (edge_of(corners, k) != edge) ++k;
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k), corners.end());
    return corners;
}

/// Whether two triangles that share an edge lie in one plane, with their normals in the same direction.
bool is_plane(Net const& net, Edge const& edge, std::vector<std::size_t> const& at, double flat) {
    if (at.size() != 2) return false;
    Corners const one = seen_from(net.triangles[at[0]], edge), other = seen_from(net.triangles[at[1]], edge);
    Point const normal = area(net.at(one));
    Point const to = minus(net.nodes[other[2]], net.nodes[one[0]]);
    return std::abs(dot(normal, to)) <= flat * length(normal) && dot(normal, area(net.at(other))) > 0;
}

/// Turns edges until none makes the smallest angle of its two triangles larger.
void flip(Net& net, double flat) {
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        std::vector<bool> is_new(net.triangles.size());
        for (auto const& [edge, at] : net.edges()) {
            if (at.size() != 2 || is_new[at[0]] || is_new[at[1]] || !is_plane(net, edge, at, flat)) continue;
            Corners const one = seen_from(net.triangles[at[0]], edge),
                          other = seen_from(net.triangles[at[1]], edge);
            Corners const left{one[2], one[0], other[2]}, right{one[1], one[2], other[2]};
            Point const normal = area(net.at(one));
            if (dot(normal, area(net.at(left))) <= 0 || dot(normal, area(net.at(right))) <= 0) continue;
            double const now = std::min(smallest_angle(net.at(one)), smallest_angle(net.at(other)));
            if (std::min(smallest_angle(net.at(left)), smallest_angle(net.at(right))) <= now * (1 + 1e-6))
                continue;
            net.triangles[at[0]] = left;
            net.triangles[at[1]] = right;
            is_new[at[0]] = is_new[at[1]] = has_changed = true;
        }
    }
}

/// Cuts long borders and folds once, in the middle. @return whether there were any
bool cut_long(Net& net, double longest, double flat) {
    std::map<Edge, std::size_t> cut;
    for (auto const& [edge, at] : net.edges()) {
        Point const &a = net.nodes[edge[0]], &b = net.nodes[edge[1]];
        if (length(minus(a, b)) <= longest || is_plane(net, edge, at, flat)) continue;
        cut[edge] = net.nodes.size();
        net.nodes.push_back(middle(a, b));
    }
    std::vector<Corners> left = std::move(net.triangles), done;
    while (!left.empty()) {
        Corners const corners = left.back();
        left.pop_back();
        std::size_t k = 0;
        while (k < 3 && !cut.contains(edge_of(corners, k))) ++k;
        if (k == 3) {
            done.push_back(corners);
            continue;
        }
        Edge const edge = edge_of(corners, k);
        Corners const c = seen_from(corners, edge);
        left.push_back({c[0], cut[edge], c[2]});
        left.push_back({cut[edge], c[1], c[2]});
    }
    net.triangles = std::move(done);
    return !cut.empty();
}

}  // namespace

std::vector<std::string> mend(Surface& surface, double tolerance, Point const& origin) {
    return Mending(surface, tolerance, origin).do_it();
}

double smallest_angle(Triangle const& t) {
    double const twice = length(area(t));
    double least = std::numbers::pi;
    for (std::size_t k = 0; k < 3; ++k) {
        Point const &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
        least = std::min(least, std::atan2(twice, dot(minus(b, a), minus(c, a))));
    }
    return least;
}

std::vector<Triangle> without_needles(std::vector<Triangle> const& triangles, double longest) {
    double const flat = 1e-4 * longest;
    std::vector<Point> unused;
    Net net = net_of(triangles, 0, unused);
    flip(net, flat);
    while (cut_long(net, longest, flat)) flip(net, flat);
    std::vector<Triangle> result;
    for (Corners const& corners : net.triangles) result.push_back(net.at(corners));
    return result;
}

}  // namespace vibrotrough::scenario
