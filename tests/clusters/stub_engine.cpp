// Stands in for LIGGGHTS where ten thousand cases are run to time the driver, and nowhere else: it answers
// with its version, and it writes what the two decks would, in no time and without any physics.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string>

namespace {

/// The number after `words` in the deck.
double number_after(std::string const& deck, char const* words) {
    auto const at = deck.find(words);
    return at == std::string::npos ? 0 : std::strtod(deck.c_str() + at + std::strlen(words), nullptr);
}

std::string content(char const* name) {
    std::ifstream file(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void settle(std::string const& deck) {
    double const mass = number_after(deck, "floor_force ${weighed} mass ");
    std::ofstream("settled.restart") << mass;
    std::printf("VIBROTROUGH SETTLED floor_force %.15g mass %.15g centre_height 0.01\n", -9.81 * mass, mass);
}

/// The layer goes with the trough but for a steady slip; one snapshot per profile.
void write_layer(std::string const& deck, int cycles, int steps, double weight) {
    double const beta = number_after(deck, "vibration angle ") * std::numbers::pi / 180;
    double const amplitude = number_after(deck, "deg, amplitude ");
    std::ofstream table("phases.csv");
    table.precision(12);
    table << "step,x_com,z_com,vx_com,vz_com,trough_x,trough_z,force_x,force_z,floor_z,touching,touching_vx,"
             "touching_spin,"
             "clearance,energy_translation,energy_rotation,overlap\n";
    for (int i = 1; i <= 100 * cycles; ++i) {
        double const place = amplitude * std::sin(2 * std::numbers::pi * i / 100);
        double const x = place * std::cos(beta), z = place * std::sin(beta);
        table << i * (steps / 100) << ',' << x << ',' << z << ",1,0," << x << ',' << z << ",-0.01," << -weight
              << ',' << -weight << ",10,10,0,-1e-6,0,0,2e-6\n";
    }
    std::ofstream("profiles.0.txt") << steps * 6 / 5 << " 1\n  1 0.001 10 700 1 0\n";
    std::ofstream("surface.0.txt") << steps * 6 / 5 << " 1\n  1 0.001 10 700 0.002\n";
}

void drive(std::string const& deck) {
    double const weight = 9.81 * std::strtod(content("settled.restart").c_str(), nullptr);
    int const grains = static_cast<int>(number_after(deck, "#   grains    "));
    int const steps = static_cast<int>(number_after(deck, "#   steps     "));
    constexpr int cycles = 24;
    std::ofstream table("cycles.csv");
    table.precision(15);
    table << "# SI units\nstep,grains,x_com,z_com,vz_com,mean_vx,mean_force_x,mean_force_z,flight_fraction\n";
    write_layer(deck, cycles, steps, weight);
    double const frequency = number_after(deck, ", frequency ");
    double x = 0.01;
    for (int k = 0; k <= cycles; ++k) {
        double const way = k % 2 == 0 ? 0.0101 : 0.0099;
        if (k > 0) x += way;
        table << k * steps << ',' << grains << ',' << x << ",0.01,0," << way * frequency << ",0.01,"
              << (k > 0 ? -weight : 0) << ",0.5\n";
    }
    std::printf("VIBROTROUGH BEGIN cycle 0\nVIBROTROUGH DONE step %d grains %d\n", cycles * steps, grains);
}

}  // namespace

int main(int argc, char** argv) {
    std::string input;
    for (int i = 1; i + 1 < argc; ++i) {
        if (std::strcmp(argv[i], "-in") == 0) input = argv[i + 1];
    }
    std::puts("LIGGGHTS (Version stub that stands in for LIGGGHTS in a benchmark)");
    if (input == "settle.liggghts") settle(content("settle.liggghts"));
    if (input == "in.liggghts") drive(content("in.liggghts"));
}
