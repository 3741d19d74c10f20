#include "store/schema.hpp"

namespace vibrotrough::store {

std::vector<PackingTable> const& rolling_tables() {
    static std::vector<PackingTable> const tables{
        {"rolling",
         {"phase", "rad", "Phase omega t since the drive's phase 0, at the end of each hundredth of a cycle"},
         packing_field([](auto& p) -> auto& { return p.rolling.phase; })},
        {"rolling", {"floor_grains", "1", "Number of grains that touch the floor"}, packing_field([
         ](auto& p) -> auto& { return p.rolling.floor_grains; })},
        {"rolling",
         {"floor_velocity", "m/s",
          "Their mean velocity along the trough, relative to it; NaN where none touches"},
         packing_field([](auto& p) -> auto& { return p.rolling.floor_velocity; })},
        {"rolling",
         {"floor_spin", "m/s",
          "Their mean omega_y R, positive when they roll forwards; NaN where none touches"},
         packing_field([](auto& p) -> auto& { return p.rolling.floor_spin; })},
        {"rolling",
         {"floor_slip", "m/s",
          "Slip of their surface on the floor, floor_velocity - floor_spin; NaN where none touches"},
         packing_field([](auto& p) -> auto& { return p.rolling.floor_slip; })},
        {"rolling",
         {"first_grains", "1",
          "Number of grains whose centre is in the first diameter above the floor or the lowest grain, "
          "whichever is higher"},
         packing_field([](auto& p) -> auto& { return p.rolling.first_grains; })},
        {"rolling",
         {"first_velocity", "m/s", "Their mean velocity along the trough, relative to it"},
         packing_field([](auto& p) -> auto& { return p.rolling.first_velocity; })},
        {"rolling", {"first_spin", "m/s", "Their mean omega_y R"}, packing_field([](auto& p) -> auto& {
             return p.rolling.first_spin;
         })},
        {"rolling", {"second_grains", "1", "The same as first_grains in the second diameter"}, packing_field([
         ](auto& p) -> auto& { return p.rolling.second_grains; })},
        {"rolling",
         {"second_velocity", "m/s", "The same as first_velocity in the second diameter"},
         packing_field([](auto& p) -> auto& { return p.rolling.second_velocity; })},
        {"rolling", {"second_spin", "m/s", "The same as first_spin in the second diameter"}, packing_field([
         ](auto& p) -> auto& { return p.rolling.second_spin; })},
        {"rolling",
         {"floor_contacts", "1", "Number of contacts with the floor that carry a normal force"},
         packing_field([](auto& p) -> auto& { return p.rolling.floor_contacts; })},
        {"rolling",
         {"sliding_share", "1",
          "Share of these contacts that slide: their friction is mu times their normal force; NaN where "
          "there is none"},
         packing_field([](auto& p) -> auto& { return p.rolling.sliding_share; })},
        {"rolling",
         {"normal_force", "N",
          "Force of the layer on the floor, normal, positive when pressing; instantaneous"},
         packing_field([](auto& p) -> auto& { return p.rolling.normal_force; })},
        {"rolling",
         {"tangential_force", "N", "Force of the layer on the floor along x; instantaneous"},
         packing_field([](auto& p) -> auto& { return p.rolling.tangential_force; })},
        {"rolling",
         {"friction", "N", "Sum over the contacts with the floor of the sizes of their tangential forces"},
         packing_field([](auto& p) -> auto& { return p.rolling.friction; })},
        {"rolling",
         {"floor_torque", "N m",
          "Torque of the floor on the grains that touch it, about y, positive when it makes them roll "
          "forwards"},
         packing_field([](auto& p) -> auto& { return p.rolling.floor_torque; })},
        {"rolling",
         {"grain_torque", "N m", "Torque of the other grains on the grains that touch the floor, about y"},
         packing_field([](auto& p) -> auto& { return p.rolling.grain_torque; })},
        {"rolling",
         {"contacts_per_floor_grain", "1",
          "Contacts with other grains per grain that touches the floor; NaN where none touches"},
         packing_field([](auto& p) -> auto& { return p.rolling.contacts_per_floor_grain; })},
        {"rolling",
         {"contacts_per_grain", "1", "Contacts with other grains and the floor per grain of the layer"},
         packing_field([](auto& p) -> auto& { return p.rolling.contacts_per_grain; })},
        {"rolling",
         {"first_fraction", "1",
          "Solid fraction of the first diameter above the floor or the lowest grain, whichever is higher"},
         packing_field([](auto& p) -> auto& { return p.rolling.first_fraction; })},
        {"rolling", {"second_fraction", "1", "Solid fraction of the second diameter"}, packing_field([
         ](auto& p) -> auto& { return p.rolling.second_fraction; })},
    };
    return tables;
}

}  // namespace vibrotrough::store
