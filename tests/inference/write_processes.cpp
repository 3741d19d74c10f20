// Writes Gaussian processes and what they say as JSON, for check_processes.py, which compares them with
// scikit-learn.

#include "inference/gaussian_process.hpp"

#include <cmath>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace vibrotrough::inference;

namespace {

/// A function of the inputs that has a step, like the theory's efficiency at a change of mode.
double theory(Eigen::VectorXd const& x) {
    return 0.3 + 0.5 * x(0) + (x(0) > 0.5 ? 0.2 * (x(0) - 0.5) : 0);
}

ProcessData make_data(Eigen::Index count, Eigen::Index inputs) {
    std::mt19937_64 random(static_cast<std::uint64_t>(10 * count + inputs));
    std::uniform_real_distribution<double> uniform;
    std::normal_distribution<double> normal;
    ProcessData data{Eigen::MatrixXd(count, inputs), Eigen::MatrixXd(count, 2), Eigen::VectorXd(count),
                     Eigen::VectorXd(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        for (Eigen::Index j = 0; j < inputs; ++j) data.inputs(i, j) = uniform(random);
        Eigen::VectorXd const x = data.inputs.row(i);
        data.trend(i, 0) = 1;
        data.trend(i, 1) = theory(x);
        data.noise(i) = 0.01 + 0.02 * uniform(random);
        data.values(i) = theory(x) + 0.2 * std::sin(4 * x(0)) + (inputs > 1 ? 0.1 * x(1) * x(1) : 0) +
                         data.noise(i) * normal(random);
    }
    return data;
}

nlohmann::json list(Eigen::VectorXd const& v) {
    return std::vector<double>(v.begin(), v.end());
}

nlohmann::json rows(Eigen::MatrixXd const& m) {
    nlohmann::json result = nlohmann::json::array();
    for (Eigen::Index i = 0; i < m.rows(); ++i) result.push_back(list(m.row(i)));
    return result;
}

nlohmann::json describe(GaussianProcess const& process, bool is_fitted, bool has_extra_noise) {
    ProcessData const& data = process.data();
    Hyperparameters const& h = process.hyperparameters();
    nlohmann::json json{{"inputs", rows(data.inputs)},        {"trend", rows(data.trend)},
                        {"values", list(data.values)},        {"noise", list(data.noise)},
                        {"deviation", h.deviation},           {"lengths", list(h.lengths)},
                        {"extra_noise", h.extra_noise},       {"is_fitted", is_fitted},
                        {"has_extra_noise", has_extra_noise}, {"log_likelihood", process.log_likelihood()}};
    for (ProcessValue const& v : process.leave_one_out())
        json["leave_one_out"].push_back({{"mean", v.mean}, {"sd", v.sd}});
    for (int i = 0; i < 7; ++i) {
        Eigen::VectorXd const x = Eigen::VectorXd::Constant(data.inputs.cols(), -0.1 + 0.2 * i);
        Eigen::VectorXd const h_of_x{{1, theory(x)}};
        ProcessValue const v = process.predict(x, h_of_x);
        json["predictions"].push_back(
            {{"inputs", list(x)}, {"trend", list(h_of_x)}, {"mean", v.mean}, {"sd", v.sd}});
    }
    return json;
}

}  // namespace

int main() {
    nlohmann::json all = nlohmann::json::array();
    TrendPrior const prior{Eigen::VectorXd{{0, 1}}, Eigen::VectorXd{{1, 1}}};
    for (Eigen::Index const inputs : {1, 2, 3}) {
        ProcessData const data = make_data(12 + 8 * inputs, inputs);
        Hyperparameters const h{0.2, Eigen::VectorXd::LinSpaced(inputs, 0.3, 0.9), 0.015};
        all.push_back(describe(GaussianProcess(data, prior, h), false, true));
        for (bool const extra : {false, true}) {
            ProcessSettings settings;
            settings.has_extra_noise = extra;
            all.push_back(describe(GaussianProcess::fitted(data, prior, settings), true, extra));
        }
    }
    fmt::print("{}\n", all.dump());
}
