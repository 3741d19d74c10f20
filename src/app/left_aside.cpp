#include "app/left_aside.hpp"

#include "app/standard_streams.hpp"

namespace vibrotrough::app {

void tell_left_aside(campaign::Plan const& plan, std::vector<campaign::CaseOverview> const& cases) {
    std::string const words = campaign::describe_left_aside(plan, cases);
    if (!words.empty()) tell("vibrotrough: left aside: {}\n", words);
}

}  // namespace vibrotrough::app
