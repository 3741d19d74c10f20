#include "app/commands/command.hpp"
#include "atlas/atlas.hpp"
#include "core/version.hpp"

namespace vibrotrough::app {
namespace {

constexpr char const* year = "2026";

void print_text() {
    fmt::print(R"(Please cite

the program:
  Vibrotrough, version {} (commit {}), {}

the point-mass theory that it solves:
  E.M. Sloot and N.P. Kruyt, Theoretical and experimental study of the transport of granular materials by inclined
  vibratory conveyors, Powder Technology 87 (1996) 203-210

the engine of its simulations, with the version that 'vibrotrough --version' prints:
  C. Kloss, C. Goniva, A. Hager, S. Amberger and S. Pirker, Models, algorithms and validation for opensource DEM and
  CFD-DEM, Progress in Computational Fluid Dynamics 12 (2012) 140-152, doi:10.1504/PCFD.2012.047457

the atlas, where you use what 'predict', 'compare' or 'design' say from it:
  {} layers that Vibrotrough {} simulated (validation/atlas of its sources), {}
)",
               core::program_version(), core::program_commit(), year, atlas::simulated_layers(),
               core::program_version(), year);
}

void print_bibtex() {
    fmt::print(R"(@software{{vibrotrough,
  title = {{Vibrotrough}},
  version = {{{}}},
  year = {{{}}},
  note = {{commit {}}}
}}
@article{{sloot1996,
  author = {{Sloot, E. M. and Kruyt, N. P.}},
  title = {{Theoretical and experimental study of the transport of granular materials by inclined vibratory conveyors}},
  journal = {{Powder Technology}},
  volume = {{87}},
  pages = {{203--210}},
  year = {{1996}}
}}
@article{{kloss2012,
  author = {{Kloss, C. and Goniva, C. and Hager, A. and Amberger, S. and Pirker, S.}},
  title = {{Models, algorithms and validation for opensource {{DEM}} and {{CFD-DEM}}}},
  journal = {{Progress in Computational Fluid Dynamics}},
  volume = {{12}},
  pages = {{140--152}},
  year = {{2012}},
  doi = {{10.1504/PCFD.2012.047457}}
}}
@misc{{vibrotrough-atlas,
  title = {{An atlas of {} layers of spheres on vibrating troughs}},
  howpublished = {{simulated by Vibrotrough {}, folder validation/atlas of its sources}},
  year = {{{}}}
}}
)",
               core::program_version(), year, core::program_commit(), atlas::simulated_layers(),
               core::program_version(), year);
}

}  // namespace

void add_cite(CLI::App& program, int& exit_code) {
    CLI::App* const command = program.add_subcommand(
        "cite", "Print what to cite: the program, the theory, the engine and the atlas");
    auto const bibtex = std::make_shared<bool>(false);
    command->add_flag("--bibtex", *bibtex, "Print BibTeX entries");
    command->footer(R"(Example:
  vibrotrough cite --bibtex >> references.bib)");
    command->callback([&exit_code, bibtex] {
        *bibtex ? print_bibtex() : print_text();
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
