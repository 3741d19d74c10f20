#include "deck/deck.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

scenario::Scenario block(std::string const& kind = "point") {
    std::string const text = with("height = \"12 mm\"", "block = \"" + kind + "\"");
    std::string const one_size = with("diameter_spread = 0.1", "", text);
    return scenario::parse_campaign(one_size, "test.toml").cases.front();
}

struct Landing {
    double rebound, tangential_impulse;  ///< in the landing speed
};

/// A landing of mass 1 with speed 1 and `slip`, without gravity, by small steps.
Landing land(prepare::BlockContact const& contact, double slip, double friction) {
    double const step = contact.duration / 20000;
    double overlap = 0, inward = 1, along = slip, force = 1;
    while (force > 0) {
        force = std::max(0.0, contact.stiffness * overlap + contact.damping * inward);
        along -= step * std::min(friction * force, contact.damping * along);
        inward -= step * force;
        overlap += step * inward;
    }
    return {-inward, slip - along};
}

// k = m / t_c^2 and c = 10 m / t_c: rates of a landing (5 -+ sqrt(24)) / t_c = a, b; the force ends at x'' =
// 0 with e = (a / b)^((b + a) / (b - a)) = 0.00928. The steps are 1/2000 of the fast rate.
TEST(BlockContact, ReboundsByLessThanOnePercent) {
    Landing const landing = land(prepare::block_contact(block(), 1, 1), 0, 0.23);
    EXPECT_NEAR(landing.rebound, 0.00928, 1e-5);
}

// Plastic landing with Coulomb friction: tangential impulse min(mu (1 + e), slip / v). The damping stops all
// but what is left when the force ends, at most e.
TEST(BlockContact, ALandingHasCoulombsImpulseOrStops) {
    prepare::BlockContact const contact = prepare::block_contact(block(), 1, 1);
    for (double const slip : {0.05, 0.1, 0.2, 0.22, 0.24, 0.26, 0.5, 5.0}) {
        Landing const landing = land(contact, slip, 0.23);
        EXPECT_NEAR(landing.tangential_impulse, std::min(slip, 0.23 * (1 + landing.rebound)), 0.0025) << slip;
    }
}

TEST(BlockContact, SpheresOfAPlateShareIt) {
    prepare::BlockContact const whole = prepare::block_contact(block(), 2e-5, 1),
                                ninth = prepare::block_contact(block(), 2e-5, 9);
    EXPECT_DOUBLE_EQ(ninth.stiffness, whole.stiffness * (5 / 1.5) * (5 / 1.5) / 9);
    EXPECT_DOUBLE_EQ(ninth.damping, whole.damping / 9);
    EXPECT_EQ(ninth.duration, whole.duration);
}

std::vector<double> numbers_of(std::string const& deck, std::string const& property) {
    std::smatch line;
    EXPECT_TRUE(std::regex_search(deck, line, std::regex(property + " peratomtypepair \\d (.*)")))
        << property;
    std::istringstream words(line[1]);
    return {std::istream_iterator<double>(words), {}};
}

TEST(BlockContact, IsWhatTheDecksSay) {
    scenario::Scenario const s = block();
    double const duration = 1 / (s.trough.frequency * s.solver.block_stiffness);
    Deck const deck = make_deck(prepare::prepare_case(s), {1});
    for (auto const& name : {"settle.liggghts", "in.liggghts"}) {
        std::string const& text = deck.files.at(name);
        EXPECT_NE(text.find("pair_style      gran model hooke/stiffness tangential no_history limitForce on "
                            "tangential_damping on\n"),
                  std::string::npos);
        EXPECT_NE(
            text.find("hooke/stiffness tangential no_history mesh n_meshes 1 meshes trough limitForce on "
                      "tangential_damping on\n"),
            std::string::npos);
        for (double const damping : numbers_of(text, "gamman")) EXPECT_NEAR(damping * duration, 10, 1e-9);
        EXPECT_EQ(numbers_of(text, "gamman"), numbers_of(text, "gammat"));
    }
    prepare::TimeGrid const time = prepare::prepare_case(s).time;
    EXPECT_LE(time.time_step, duration / 20);
    EXPECT_GE(time.time_step, duration / 20 * 0.98);  // 6000 steps are made a multiple of 100
}

// A plate that leaves the trough tilted spins and lands on its edges; a force that may pull keeps it flat.
TEST(BlockContact, APlateMayPull) {
    scenario::Scenario plate = block();
    plate.layer.block = scenario::Block::plate;
    plate.grains.rotation = scenario::Rotation::free;
    Deck const deck = make_deck(prepare::prepare_case(plate), {1});
    for (auto const& name : {"settle.liggghts", "in.liggghts"})
        EXPECT_NE(deck.files.at(name).find("no_history limitForce off tangential_damping on\n"),
                  std::string::npos);
    EXPECT_TRUE(prepare::block_contact(plate, 1, 9).pulls);
    EXPECT_FALSE(prepare::block_contact(block(), 1, 1).pulls);
}

}  // namespace
}  // namespace vibrotrough::deck
