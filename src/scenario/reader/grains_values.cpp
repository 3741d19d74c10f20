#include "scenario/model/scenario.hpp"
#include "scenario/reader/given_values.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Reads the section [grains].
class GrainsReader {
  public:
    explicit GrainsReader(GivenValues const& given) : given_(given) {}

    Grains grains() const {
        Grains grains{.diameter = 0,
                      .diameter_spread = given_.number("grains.diameter_spread"),
                      .density = density(),
                      .youngs_modulus = modulus(),
                      .poisson_ratio = given_.number("grains.poisson_ratio"),
                      .friction = given_.number("grains.friction"),
                      .restitution = given_.number("grains.restitution"),
                      .rolling_friction = 0,
                      .rotation = Rotation::free,
                      .size_law = SizeLaw::three_classes,
                      .diameters = {},
                      .number_fractions = {},
                      .mass_fractions = {},
                      .shape = given_.word("grains.shape"),
                      .shape_file = nullptr};
        set_rotation(grains);
        set_sizes(grains);
        if (is_clump(grains)) set_shape(grains);
        return grains;
    }

  private:
    double density() const {
        if (Value const* bulk = given_.find("grains.bulk_density"))
            return bulk->number() / settled_solid_fraction;
        return given_.number("grains.density");
    }

    std::optional<double> modulus() const {
        if (Value const* given = given_.find("grains.youngs_modulus")) return given->number();
        if (given_.number("engine.cohesion") > 0) {
            given_.fail("grains.youngs_modulus",
                        "is missing; it cannot be chosen for cohesive grains, because the pull that "
                        "engine.cohesion means depends on it",
                        "write the modulus for which the cohesion was found, such as \"5 MPa\"");
        }
        return {};
    }

    void set_rotation(Grains& grains) const {
        std::string const rotation = given_.word("grains.rotation");
        double const rolling_friction = given_.number("grains.rolling_friction");
        if (rotation == "rolling") {
            grains.rotation = Rotation::rolling;
            grains.rolling_friction = rolling_friction;
            if (!(rolling_friction > 0))
                given_.fail("grains.rotation", "rotation is \"rolling\", but rolling_friction is not above 0",
                            "write rolling_friction = 0.1 or rotation = \"free\"");
        } else if (rolling_friction > 0 && given_.find("grains.rotation") == nullptr) {
            given_.fail("grains.rolling_friction", "has no effect on grains that rotate freely",
                        "write rotation = \"rolling\" as well");
        }
        if (rotation == "blocked") grains.rotation = Rotation::blocked;
    }

    void set_sizes(Grains& grains) const {
        std::string const law = given_.word("grains.size_law");
        if (law == "uniform") grains.size_law = SizeLaw::uniform;
        if (law == "lognormal") grains.size_law = SizeLaw::lognormal;
        Value const* const list = given_.find("grains.diameters");
        for (char const* fractions : {"grains.number_fractions", "grains.mass_fractions"}) {
            if (list == nullptr && given_.find(fractions) != nullptr)
                given_.fail(fractions, "is given without a list of as many diameters",
                            "write diameters = [\"2 mm\", \"3 mm\"]");
        }
        if (list == nullptr) {
            grains.diameter = given_.number("grains.diameter");
            return;
        }
        for (char const* other : {"grains.size_law", "grains.diameter_spread"}) {
            if (given_.find(other) != nullptr)
                given_.fail(other, "is given together with a list of diameters", "remove it");
        }
        grains.size_law = SizeLaw::listed;
        grains.diameters = list->numbers();
        grains.number_fractions = fractions("grains.number_fractions", grains.diameters.size());
        grains.mass_fractions = fractions("grains.mass_fractions", grains.diameters.size());
        if (grains.number_fractions.empty() == grains.mass_fractions.empty()) {
            given_.fail("grains.diameters", "needs exactly one of number_fractions and mass_fractions",
                        "write mass_fractions = [0.3, 0.7]");
        }
        for (SizeClass const& size : size_classes(grains))
            grains.diameter += size.number_fraction * size.diameter;
    }

    std::vector<double> fractions(std::string_view key, std::size_t count) const {
        Value const* const value = given_.find(key);
        if (value == nullptr) return {};
        if (value->numbers().size() != count) {
            given_.fail(key, fmt::format("has {} values for {} diameters", value->numbers().size(), count),
                        "list one fraction for each diameter");
        }
        return value->numbers();
    }

    void set_shape(Grains& grains) const {
        try {
            if (grains.shape != "cube" && grains.shape != "rod") {
                auto& known = given_.files_read().shapes[grains.shape];
                if (!known) known = read_shape(given_.named_file("grains.shape"));
                grains.shape_file = known;
            }
        } catch (std::invalid_argument const& error) {
            given_.fail("grains.shape", fmt::format("{}: {}", grains.shape, error.what()),
                        "write the header x,y,z,radius and one sphere per line");
        }
        if (size_classes(grains).size() > 1) {
            given_.fail("grains.shape", "clumps must all have the same size",
                        "leave out diameter_spread (or write 0), or use spheres");
        }
        if (grains.rotation == Rotation::rolling) {
            given_.fail("grains.shape", "the model of rolling friction is only for spheres",
                        "write rotation = \"free\" or \"blocked\"");
        }
    }

    GivenValues const& given_;
};

}  // namespace

Grains read_grains(GivenValues const& given) {
    return GrainsReader(given).grains();
}

}  // namespace vibrotrough::scenario
