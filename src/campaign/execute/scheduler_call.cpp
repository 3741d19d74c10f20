#include "campaign/execute/scheduler_call.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <future>
#include <sstream>

#include <boost/process.hpp>
#include <fmt/format.h>

namespace vibrotrough::campaign {

namespace bp = boost::process;

namespace {

std::optional<long> minutes_in(std::string const& text) {
    auto const dash = text.find('-');
    long const days = dash == std::string::npos ? 0 : number_in<long>(text.substr(0, dash)).value_or(0);
    long seconds = 0;
    auto const rows = rows_of(dash == std::string::npos ? text : text.substr(dash + 1), ':');
    for (std::string const& part : rows.empty() ? std::vector<std::string>{""} : rows.front()) {
        auto const number = number_in<long>(part);
        if (!number) return {};
        seconds = 60 * seconds + *number;
    }
    return days * 24 * 60 + seconds / 60;
}

}  // namespace

bool CallAnswer::complains_of(std::vector<std::string_view> const& texts) const {
    return std::ranges::any_of(texts,
                               [&](std::string_view text) { return errors.find(text) != std::string::npos; });
}

std::string CallAnswer::words() const {
    std::string const& text = errors.empty() ? output : errors;
    return text.substr(0, text.find('\n')).substr(0, 300);
}

bool has_command(std::string const& name) {
    return !bp::search_path(name).empty();
}

CallAnswer call_scheduler(std::string_view title, std::vector<std::string> words) {
    auto const program = bp::search_path(words.front());
    if (program.empty()) {
        throw core::MissingError(fmt::format(
            "there is no {} here; run where {} is installed, or write executor = \"local\" under [run]",
            words.front(), title));
    }
    words.front() = program.string();
    words.insert(words.begin(), "60");
    try {
        boost::asio::io_context context;
        std::future<std::string> output, errors;
        bp::child child(bp::search_path("timeout"), bp::args(words), bp::std_in<bp::null, bp::std_out> output,
                        bp::std_err > errors, context);
        context.run();
        child.wait();
        return {child.exit_code(), core::harmless(output.get()), core::harmless(errors.get())};
    } catch (bp::process_error const& error) {
        throw core::MissingError(fmt::format("cannot start {} ({})", words[1], error.code().message()));
    }
}

CallAnswer call_or_throw(std::string_view title, std::vector<std::string> words) {
    CallAnswer answer = call_scheduler(title, std::move(words));
    if (answer.code == 0) return answer;
    throw core::MissingError(
        fmt::format("{} does not answer ({}); try again when it does", title, answer.words()));
}

core::MissingError refusal(std::string_view title, CallAnswer const& answer, std::string_view see) {
    return core::MissingError(
        fmt::format("{} does not take the job ({}); see {}", title, answer.words(), see));
}

std::vector<std::vector<std::string>> rows_of(std::string const& table, char separator) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream text(line);
        std::vector<std::string>& parts = rows.emplace_back();
        for (std::string part; std::getline(text, part, separator);) {
            auto const end = part.find_last_not_of(' ');
            parts.push_back(end == std::string::npos ? "" : part.substr(0, end + 1));
        }
    }
    return rows;
}

void check_time_limit(std::string_view section, std::string_view place, std::string const& limit,
                      scenario::BatchSettings const& asked) {
    auto const most = minutes_in(limit);
    if (!asked.minutes || !most || *asked.minutes <= *most) return;
    throw core::MissingError(fmt::format(
        "{} has a limit of {} minutes, and {}.time asks for {}{}; ask for less, or for another partition",
        place, *most, section, *asked.minutes,
        asked.minutes_per_task ? " for the largest task of several packings" : ""));
}

std::map<long, std::string> name_by_id(std::vector<SubmittedArray>& arrays,
                                       std::optional<long> (*find_by_name)(std::string const& name)) {
    std::map<long, std::string> names;
    for (SubmittedArray& array : arrays) {
        if (!array.job) array.job = find_by_name(array.name);
        if (array.job) names.emplace(*array.job, array.name);
    }
    return names;
}

std::string ids_of(std::map<long, std::string> const& name_by_id) {
    std::string ids;
    for (auto const& [id, name] : name_by_id) ids += fmt::format("{}{}", ids.empty() ? "" : ",", id);
    return ids;
}

}  // namespace vibrotrough::campaign
