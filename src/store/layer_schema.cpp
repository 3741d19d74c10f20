#include "store/schema.hpp"

namespace vibrotrough::store {

std::vector<PackingTable> const& packing_tables() {
    static std::vector<PackingTable> const tables{
        {"phases",
         {"phase", "rad",
          "Phase omega t since the drive's phase 0, at the end of each hundredth of a cycle; over one period "
          "of the layer's motion"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.phase; })},
        {"phases",
         {"displacement", "m", "Displacement of the centre of mass against the trough since phase 0"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.displacement; })},
        {
            "phases",
            {"height", "m", "Height of the centre of mass above the trough"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.height; }),
        },
        {
            "phases",
            {"velocity_x", "m/s", "Velocity of the centre of mass along the trough"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_x; }),
        },
        {"phases",
         {"velocity_z", "m/s", "Velocity of the centre of mass normal to the trough"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_z; })},
        {
            "phases",
            {"trough_velocity_x", "m/s", "Velocity of the trough along x"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.trough_velocity_x; }),
        },
        {
            "phases",
            {"trough_velocity_z", "m/s", "Velocity of the trough along z"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.trough_velocity_z; }),
        },
        {"phases",
         {"normal_force", "N",
          "Force of the layer on the trough, normal, positive when pressing; mean over the hundredth that "
          "ends"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.normal_force; })},
        {"phases",
         {"tangential_force", "N",
          "Force of the layer on the trough along x; mean over the hundredth that ends"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.tangential_force; })},
        {"phases",
         {"floor_force", "N", "The part of normal_force that the floor carries, not side walls"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.floor_force; })},
        {"phases",
         {"touching", "1", "Number of grains (of clumps: spheres) whose lowest point is below the floor"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.touching; })},
        {"phases",
         {"airborne", "1", "Fraction of the periods in which nothing touches the trough"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.airborne; })},
        {"phases",
         {"clearance", "m", "Gap between floor and lowest grain; negative: overlap"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.clearance; })},
        {"phases",
         {"slip", "m/s",
          "Slip of the touching grains' surface on the floor, v_x - omega_y R - V, mean over them; NaN where "
          "none touches"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.slip; })},
        {
            "phases",
            {"sliding", "m/s", "The same without their rotation, v_x - V"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.sliding; }),
        },
        {
            "phases",
            {"energy_translation", "J", "Kinetic energy of the grains' translation"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.energy_translation; }),
        },
        {
            "phases",
            {"energy_rotation", "J", "Kinetic energy of the grains' rotation"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.energy_rotation; }),
        },
        {
            "phases",
            {"overlap", "m", "Largest overlap of two grains in any of the periods"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.overlap; }),
        },
        {"phases",
         {"displacement_deviation", "m", "Standard deviation of displacement over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.displacement_deviation; })},
        {
            "phases",
            {"height_deviation", "m", "Standard deviation of height over the periods"},
            packing_field([](auto& p) -> auto& { return p.motion.curves.height_deviation; }),
        },
        {"phases",
         {"velocity_x_deviation", "m/s", "Standard deviation of velocity_x over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_x_deviation; })},
        {"phases",
         {"velocity_z_deviation", "m/s", "Standard deviation of velocity_z over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.velocity_z_deviation; })},
        {"phases",
         {"normal_force_deviation", "N", "Standard deviation of normal_force over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.normal_force_deviation; })},
        {"phases",
         {"tangential_force_deviation", "N", "Standard deviation of tangential_force over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.tangential_force_deviation; })},
        {"phases",
         {"touching_deviation", "1", "Standard deviation of touching over the periods"},
         packing_field([](auto& p) -> auto& { return p.motion.curves.touching_deviation; })},
        {"profiles", {"phase", "rad", "Phase of the snapshot"}, packing_field([](auto& p) -> auto& {
             return p.profiles.phase;
         })},
        {
            "profiles",
            {"height", "m", "Middle of the bin above the trough"},
            packing_field([](auto& p) -> auto& { return p.profiles.height; }),
        },
        {"profiles",
         {"solid_fraction", "1",
          "Volume of the grains with their centres in the bin over its volume, mean over the snapshots"},
         packing_field([](auto& p) -> auto& { return p.profiles.solid_fraction; })},
        {"profiles",
         {"velocity_x", "m/s",
          "Their mean velocity along the trough, relative to it; NaN where no grain ever was"},
         packing_field([](auto& p) -> auto& { return p.profiles.velocity_x; })},
        {"profiles",
         {"velocity_z", "m/s",
          "Their mean velocity normal to the trough, relative to it; NaN where no grain ever was"},
         packing_field([](auto& p) -> auto& { return p.profiles.velocity_z; })},
        {"surface", {"phase", "rad", "Phase of the snapshot"}, packing_field([](auto& p) -> auto& {
             return p.surface.phase;
         })},
        {"surface", {"x", "m", "Middle of the column along the trough"}, packing_field([](auto& p) -> auto& {
             return p.surface.x;
         })},
        {"surface",
         {"height", "m",
          "Surface above the trough, twice the mean height of the column's grains, in the last snapshot of "
          "that phase; NaN without a grain"},
         packing_field([](auto& p) -> auto& { return p.surface.height; })},
    };
    return tables;
}

}  // namespace vibrotrough::store
