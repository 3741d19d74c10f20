#include "store/layer_tables.hpp"

namespace vibrotrough::store {
namespace {

using Curves = measure::PhaseCurves;

bool always(scenario::Scenario const& /*scenario*/) {
    return true;
}

auto cycle(std::vector<double> measure::CycleSeries::*member) {
    return field(&PackingRecord::series, member);
}

auto curve(std::vector<double> Curves::*member) {
    return field(&PackingRecord::motion, &measure::LayerMotion::curves, member);
}

auto profile(std::vector<double> measure::Profiles::*member) {
    return field(&PackingRecord::profiles, member);
}

auto surface(std::vector<double> measure::Surface::*member) {
    return field(&PackingRecord::surface, member);
}

PackingTable cycle_ends_table() {
    using Series = measure::CycleSeries;
    return {
        "cycle_ends",
        "cycles + 1",
        always,
        {{{"centre_of_mass_x", "m", "Centre of mass along the trough at the end of cycle 0 ... n, unwrapped"},
          cycle(&Series::x)},
         {{"centre_of_mass_z", "m", "Centre of mass above the resting trough at the end of cycle 0 ... n"},
          cycle(&Series::z)},
         {{"centre_of_mass_velocity_z", "m/s",
           "Velocity of the centre of mass normal to the trough at the end of cycle 0 ... n"},
          cycle(&Series::vz)}}};
}

PackingTable series_table() {
    using Series = measure::CycleSeries;
    return {
        "series",
        "cycles",
        always,
        {{{"normal_force", "N",
           "Force of the layer on the trough, normal, cycle mean, positive when pressing"},
          cycle(&Series::normal_force)},
         {{"tangential_force", "N", "Force of the layer on the trough along x, cycle mean"},
          cycle(&Series::tangential_force)},
         {{"flight_fraction", "1", "Fraction of the cycle without contact between layer and trough"},
          cycle(&Series::flight_fraction)},
         {{"mean_velocity", "m/s", "Velocity of the centre of mass along the trough, cycle mean"},
          cycle(&Series::mean_velocity)},
         {{"efficiency", "1", "Velocity efficiency eta of each cycle"}, field(&PackingRecord::efficiency)}}};
}

std::vector<PackingColumn> curves_of_motion() {
    return {
        {{"phase", "rad",
          "Phase omega t since the drive's phase 0, at the end of each hundredth of a cycle; over one period "
          "of the layer's motion"},
         curve(&Curves::phase)},
        {{"displacement", "m", "Displacement of the centre of mass against the trough since phase 0"},
         curve(&Curves::displacement)},
        {{"height", "m", "Height of the centre of mass above the trough"}, curve(&Curves::height)},
        {{"velocity_x", "m/s", "Velocity of the centre of mass along the trough"},
         curve(&Curves::velocity_x)},
        {{"velocity_z", "m/s", "Velocity of the centre of mass normal to the trough"},
         curve(&Curves::velocity_z)},
        {{"trough_velocity_x", "m/s", "Velocity of the trough along x"}, curve(&Curves::trough_velocity_x)},
        {{"trough_velocity_z", "m/s", "Velocity of the trough along z"}, curve(&Curves::trough_velocity_z)},
        {{"normal_force", "N",
          "Force of the layer on the trough, normal, positive when pressing; mean over the hundredth that "
          "ends"},
         curve(&Curves::normal_force)},
        {{"tangential_force", "N",
          "Force of the layer on the trough along x; mean over the hundredth that ends"},
         curve(&Curves::tangential_force)},
        {{"floor_force", "N", "The part of normal_force that the floor carries, not side walls"},
         curve(&Curves::floor_force)},
    };
}

std::vector<PackingColumn> curves_of_contacts() {
    return {
        {{"touching", "1", "Number of grains (of clumps: spheres) whose lowest point is below the floor"},
         curve(&Curves::touching)},
        {{"airborne", "1", "Fraction of the periods in which nothing touches the trough"},
         curve(&Curves::airborne)},
        {{"clearance", "m", "Gap between floor and lowest grain; negative: overlap"},
         curve(&Curves::clearance)},
        {{"slip", "m/s",
          "Slip of the touching grains' surface on the floor, v_x - omega_y R - V, mean over them; NaN where "
          "none touches"},
         curve(&Curves::slip)},
        {{"sliding", "m/s", "The same without their rotation, v_x - V"}, curve(&Curves::sliding)},
        {{"energy_translation", "J", "Kinetic energy of the grains' translation"},
         curve(&Curves::energy_translation)},
        {{"energy_rotation", "J", "Kinetic energy of the grains' rotation"}, curve(&Curves::energy_rotation)},
        {{"overlap", "m", "Largest overlap of two grains in any of the periods"}, curve(&Curves::overlap)},
    };
}

void add_deviation(std::vector<PackingColumn>& columns, std::string const& name, std::string const& units,
                   std::vector<double> Curves::*member) {
    columns.push_back(
        {{name + "_deviation", units, "Standard deviation of " + name + " over the periods"}, curve(member)});
}

PackingTable phases_table() {
    PackingTable table{"phases", "samples", always, curves_of_motion()};
    for (PackingColumn& column : curves_of_contacts()) table.columns.push_back(std::move(column));
    add_deviation(table.columns, "displacement", "m", &Curves::displacement_deviation);
    add_deviation(table.columns, "height", "m", &Curves::height_deviation);
    add_deviation(table.columns, "velocity_x", "m/s", &Curves::velocity_x_deviation);
    add_deviation(table.columns, "velocity_z", "m/s", &Curves::velocity_z_deviation);
    add_deviation(table.columns, "normal_force", "N", &Curves::normal_force_deviation);
    add_deviation(table.columns, "tangential_force", "N", &Curves::tangential_force_deviation);
    add_deviation(table.columns, "touching", "1", &Curves::touching_deviation);
    return table;
}

PackingTable profiles_table() {
    using Profiles = measure::Profiles;
    return {"profiles",
            "bins",
            always,
            {{{"phase", "rad", "Phase of the snapshot"}, profile(&Profiles::phase)},
             {{"height", "m", "Middle of the bin above the trough"}, profile(&Profiles::height)},
             {{"solid_fraction", "1",
               "Volume of the grains with their centres in the bin over its volume, mean over the snapshots"},
              profile(&Profiles::solid_fraction)},
             {{"velocity_x", "m/s",
               "Their mean velocity along the trough, relative to it; NaN where no grain ever was"},
              profile(&Profiles::velocity_x)},
             {{"velocity_z", "m/s",
               "Their mean velocity normal to the trough, relative to it; NaN where no grain ever was"},
              profile(&Profiles::velocity_z)}}};
}

PackingTable surface_table() {
    using Surface = measure::Surface;
    return {"surface",
            "columns",
            always,
            {{{"phase", "rad", "Phase of the snapshot"}, surface(&Surface::phase)},
             {{"x", "m", "Middle of the column along the trough"}, surface(&Surface::x)},
             {{"height", "m",
               "Surface above the trough, twice the mean height of the column's grains, in the last snapshot "
               "of that phase; NaN without a grain"},
              surface(&Surface::height)}}};
}

}  // namespace

std::vector<PackingTable> layer_tables() {
    return {cycle_ends_table(), series_table(), phases_table(), profiles_table(), surface_table()};
}

}  // namespace vibrotrough::store
