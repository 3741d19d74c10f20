#include "theory/batch.hpp"

#include "theory/errors.hpp"

#include <ctime>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace vibrotrough::theory {
namespace {

/// Keeps the error of the first invalid point in input order, no matter which thread finds it first.
class FirstError {
  public:
    void note(std::size_t index, std::string const& message) {
        std::lock_guard const lock(mutex_);
        if (found_ && index >= index_) return;
        found_ = true;
        index_ = index;
        message_ = message;
    }
    void raise(std::size_t first) const {
        if (found_) throw std::invalid_argument("point " + std::to_string(index_ + first) + ": " + message_);
    }

  private:
    std::mutex mutex_;
    bool found_ = false;
    std::size_t index_ = 0;
    std::string message_;
};

}  // namespace

BatchResult solve_batch(std::vector<Inputs> const& inputs, int jobs, std::optional<RollingLaw> const& rolling,
                        std::size_t first, int starts) {
    static_cast<void>(PointSolver(rolling));  // its constants are checked once, not in a thread
    check_starts(starts, rolling);
    BatchResult answer{std::vector<Efficiency>(inputs.size()), {}, 0};
    if (starts > 0) answer.motions.resize(inputs.size());
    FirstError first_error;
    tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
    std::clock_t const start = std::clock();
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, inputs.size(), 64), [&](auto const& range) {
            PointSolver solver(rolling);
            MotionSurvey survey;
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                try {
                    answer.points[i] = solver(inputs[i]);
                    if (starts > 0)
                        answer.motions[i] = survey(inputs[i].conveyor(), answer.points[i], starts);
                } catch (PhaseError const&) {
                    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
                    answer.points[i] = {unknown, 0, 0, Outcome::unsettled, unknown};
                } catch (std::invalid_argument const& error) {
                    first_error.note(i, error.what());
                }
            }
        });
    });
    first_error.raise(first);
    auto const count = static_cast<double>(inputs.empty() ? 1 : inputs.size());
    answer.cpu_seconds_per_solution = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / count;
    return answer;
}

}  // namespace vibrotrough::theory
