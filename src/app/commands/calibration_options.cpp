#include "app/commands/calibration_options.hpp"

#include "app/commands/command.hpp"
#include "app/python.hpp"
#include "core/temporary_folder.hpp"

#include <chrono>

namespace vibrotrough::app {

using namespace std::chrono_literals;

char const* const calibration_help =
    R"(The first line of the file names its columns, in any order: stroke_mm or amplitude_mm (half the stroke); rpm or
frequency_hz; vibration_angle_deg; inclination_deg (uphill positive; level if it is missing); speed_m_per_s or
speed_m_per_min; and uncertainty_m_per_s or uncertainty_m_per_min, its standard uncertainty (one standard
deviation). An angle that is free or fixed needs no column. Each further line is one measurement. Decimal commas are read when the separator is a semicolon
or a tab.

Prints the median and the 95 % interval of each free quantity, how far the Markov chains can be trusted (R-hat at most
1.01, effective sample size at least 400), and by how much the speeds narrowed the range that was possible before; a
quantity whose range stays wider than half is not identifiable from these speeds. The model discrepancy is the standard
deviation of what the model misses from setting to setting, in velocity efficiency; it is estimated with the rest.)";

void CalibrationOptions::add_to(CLI::App& command) {
    command.add_option("--free", free, "Quantities to find, separated by commas")
        ->required()
        ->delimiter(',')
        ->expected(1)
        ->type_name("NAME[,NAME...]")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_repeated(command, "--prior", priors,
                 "Range of a free quantity, each value as likely, for example friction=0.2:0.6; repeat the "
                 "option for several",
                 "NAME=LOW:HIGH");
    quantities.add_to(command, {{"--uncertainty", "",
                                 "Standard uncertainty of speeds that have none in the file, as a fraction, "
                                 "for example 0.03"},
                                {"--common-error"},
                                {"--seed"}});
    command.add_flag("--without-discrepancy", exact, "Take the model to be exact");
    add_text(command, "--plot", plot,
             "Draw the distributions of all pairs (corner plot) into this PNG or SVG file", "FILE");
    add_text(command, "--page", page, "Write a page of one screen about the result into this HTML file",
             "FILE");
    add_text(command, "--posterior", posterior,
             "Write the draws of the result into this JSON file, for 'vibrotrough design --posterior FILE'",
             "FILE");
    outputs.add_to(command);
    add_python(command, python);
    command.add_flag("--json", json, "Print JSON");
}

std::vector<learn::MeasuredSpeed> CalibrationOptions::read_speeds(std::string const& file) {
    outputs.inputs.emplace_back(file);
    if (!plot.empty()) outputs.check("--plot", plot, "Calibration by Vibrotrough");
    if (!page.empty()) outputs.check("--page", page, page_mark);
    if (!posterior.empty()) outputs.check("--posterior", posterior, "\"model_discrepancy\"");
    auto speeds =
        learn::read_speeds(core::read_text_file(file).content, file, quantities.value("--uncertainty"));
    for (std::string const& sentence : learn::unusual_speeds(speeds))
        tell("vibrotrough: warning: {}: {}\n", file, sentence);
    return speeds;
}

std::pair<std::string, std::string> split_setting(std::string const& option, std::string const& text,
                                                  std::string const& example) {
    auto const equal = text.find('=');
    if (equal == std::string::npos || equal == 0) {
        throw core::InputError(
            fmt::format("{} {}: needs NAME=VALUE; write for example {} {}", option, text, option, example));
    }
    return {text.substr(0, equal), text.substr(equal + 1)};
}

std::vector<learn::FreeParameter> CalibrationOptions::parameters(
    std::vector<learn::FreeParameter> const& known) const {
    std::vector<learn::FreeParameter> result;
    for (std::string const& name : free) {
        auto const found = std::ranges::find(known, name, &learn::FreeParameter::name);
        if (found == known.end()) {
            std::vector<std::string> names;
            for (auto const& p : known) names.push_back(p.name);
            throw core::InputError(fmt::format("--free {}: there is no such quantity; choose from {}", name,
                                               fmt::join(names, ", ")));
        }
        result.push_back(*found);
    }
    for (std::string const& text : priors) {
        char const* const example = "friction=0.2:0.6";
        auto const [name, range] = split_setting("--prior", text, example);
        auto const found = std::ranges::find(result, name, &learn::FreeParameter::name);
        if (found == result.end()) {
            throw core::InputError(fmt::format(
                "--prior {}: {} is not free; add it to --free or leave the option out", text, name));
        }
        auto const colon = range.find(':');
        if (colon == std::string::npos) {
            throw core::InputError(
                fmt::format("--prior {}: needs LOW:HIGH; write for example --prior {}", text, example));
        }
        auto const usual = std::ranges::find(known, name, &learn::FreeParameter::name)->prior;
        double const least = std::min(usual.low, 0.0), most = 2 * usual.high;
        found->prior = {read_number_within("--prior", range.substr(0, colon), example, least, most),
                        read_number_within("--prior", range.substr(colon + 1), example, least, most)};
        if (!(found->prior.low < found->prior.high)) {
            throw core::InputError(fmt::format(
                "--prior {}: the first value must be below the second; write for example --prior {}", text,
                example));
        }
    }
    return result;
}

learn::CalibrationSettings CalibrationOptions::settings() const {
    learn::CalibrationSettings result;
    if (exact) result.discrepancy = learn::Discrepancy::none;
    result.common_error = quantities.value("--common-error").value_or(result.common_error);
    if (auto const seed = quantities.value("--seed")) result.sampler.seed = static_cast<std::uint64_t>(*seed);
    result.sampler.progress = [next = std::chrono::steady_clock::now() + 2s](int steps, int most) mutable {
        if (std::chrono::steady_clock::now() < next) return;
        next = std::chrono::steady_clock::now() + 10s;
        tell("calibrating: step {} of at most {}\n", steps, most);
    };
    return result;
}

void print_calibration(CalibrationOptions const& options, learn::Calibration const& calibration,
                       std::string const& model) {
    if (!options.plot.empty()) {
        core::TemporaryFolder const folder("vibrotrough-calibration");
        auto const data = folder.path() / "calibration.json";
        core::write_file_atomically(data, learn::corner_plot_data(calibration, model).dump());
        run_script("vibrotrough.figures.corner",
                   {data.string(), "--output", std::filesystem::absolute(options.plot).string()},
                   options.python, {"numpy", "matplotlib"});
    }
    if (!options.posterior.empty())
        core::write_file_atomically(options.posterior,
                                    learn::corner_plot_data(calibration, model).dump() + "\n");
    if (!options.page.empty())
        write_decision_page(learn::corner_plot_data(calibration, model), "calibration", options.page,
                            options.python);
    if (options.json) {
        fmt::print("{}\n", learn::calibration_json(calibration, model).dump(2));
    } else {
        fmt::print("{}", learn::calibration_text(calibration, model));
    }
}

}  // namespace vibrotrough::app
