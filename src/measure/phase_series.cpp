#include "measure/phase_series.hpp"

#include "measure/table_file.hpp"

#include <algorithm>
#include <stdexcept>

namespace vibrotrough::measure {

PhaseSeries read_phases(std::filesystem::path const& path, int steps_per_cycle) {
    return parse_phases(core::read_text_file(path), steps_per_cycle);
}

PhaseSeries parse_phases(core::TextFile const& file, int steps_per_cycle) {
    if (steps_per_cycle % PhaseSeries::per_cycle != 0)
        throw std::invalid_argument("the steps per cycle are not a multiple of the lines per cycle");
    int const distance = steps_per_cycle / PhaseSeries::per_cycle;
    TableFormat const format{
        "phases",
        "step,x_com,z_com,vx_com,vz_com,trough_x,trough_z,force_x,force_z,floor_z,touching,"
        "touching_vx,touching_spin,clearance,energy_translation,energy_rotation,overlap",
        distance, distance};
    PhaseSeries series;
    parse_table(file, format, [&series](int, std::span<double const> row) {
        series.x.push_back(row[1]);
        series.z.push_back(row[2]);
        series.vx.push_back(row[3]);
        series.vz.push_back(row[4]);
        series.trough_x.push_back(row[5]);
        series.trough_z.push_back(row[6]);
        series.tangential_force.push_back(row[7]);
        series.normal_force.push_back(-row[8]);  // in the file the force on the trough is positive upwards
        series.floor_force.push_back(-row[9]);
        series.touching.push_back(row[10]);
        series.touching_vx.push_back(row[11]);
        series.touching_spin.push_back(row[12]);
        series.clearance.push_back(row[13]);
        series.energy_translation.push_back(row[14]);
        series.energy_rotation.push_back(row[15]);
        // Without contacts the engine writes its most negative number as the maximum.
        series.overlap.push_back(std::max(row[16], 0.0));
    });
    return series;
}

PhaseSeries with_integrated_positions(PhaseSeries series, double interval) {
    for (std::size_t i = 1; i < series.lines(); ++i)
        series.x[i] = series.x[i - 1] + (series.vx[i - 1] + series.vx[i]) / 2 * interval;
    return series;
}

}  // namespace vibrotrough::measure
