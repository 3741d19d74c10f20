#include "cvode_conveyor.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace vibrotrough::theory {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double relative = 1e-9, absolute = 1e-11, same = 1e-8;
constexpr int most_cycles = 400;

enum Phase { rest, forwards, backwards, flight };

/// x' = v; v' by phase; gap and its rate in a flight.
struct Problem {
    double weight, gravity, kinetic, static_limit, landing, drag, ratio, lead;
    Phase phase = rest;

    explicit Problem(Conveyor const& c)
        : weight(1 / c.point.throw_number),
          gravity(c.point.tan_inclination * c.point.tan_vibration_angle * weight),
          kinetic(c.point.friction * c.point.tan_vibration_angle),
          static_limit(std::max(c.static_friction, c.point.friction) * c.point.tan_vibration_angle),
          landing(c.landing_friction.value_or(c.point.friction) * c.point.tan_vibration_angle),
          drag(c.air_drag),
          ratio(c.along_ratio),
          lead(c.along_phase) {}

    double force(double t) const { return weight - std::sin(t) + drag * std::cos(t); }
    /// The friction that rest needs.
    double needed(double t) const {
        return gravity - ratio * std::sin(t + lead) + drag * ratio * std::cos(t + lead);
    }
    double acceleration(double t, double v) const {
        double const free = -needed(t) - drag * v;
        if (phase == forwards) return free - kinetic * force(t);
        if (phase == backwards) return free + kinetic * force(t);
        return free;
    }
    /// The phase that begins at t with velocity v in contact.
    Phase in_contact(double t, double v) const {
        if (v != 0) return v > 0 ? forwards : backwards;
        if (std::abs(needed(t)) <= static_limit * force(t) + 1e-12) return rest;
        return needed(t) < 0 ? forwards : backwards;
    }
};

int derivative(double t, N_Vector y, N_Vector rate, void* data) {
    auto const& p = *static_cast<Problem const*>(data);
    double const* const u = N_VGetArrayPointer(y);
    double* const r = N_VGetArrayPointer(rate);
    bool const rests = p.phase == rest, flies = p.phase == flight;
    r[0] = rests ? 0 : u[1];
    r[1] = rests ? 0 : p.acceleration(t, u[1]);
    r[2] = flies ? u[3] : 0;
    r[3] = flies ? -p.force(t) - p.drag * u[3] : 0;
    return 0;
}

/// Roots: the landing or the take-off, and the end of the slide or of the rest in both directions.
int events(double t, N_Vector y, double* g, void* data) {
    auto const& p = *static_cast<Problem const*>(data);
    double const* const u = N_VGetArrayPointer(y);
    g[0] = p.phase == flight ? u[2] : p.force(t);
    g[1] = p.phase == rest ? p.static_limit * p.force(t) - p.needed(t) : p.phase == flight ? 1 : u[1];
    g[2] = p.phase == rest ? p.static_limit * p.force(t) + p.needed(t) : 1;
    return 0;
}

class Integrator {
  public:
    explicit Integrator(Conveyor const& c) : problem_(c) {
#if SUNDIALS_VERSION_MAJOR >= 7
        SUNContext_Create(SUN_COMM_NULL, &context_);
#else
        SUNContext_Create(nullptr, &context_);
#endif
        y_ = N_VNew_Serial(4, context_);
        N_VConst(0, y_);
        cvode_ = CVodeCreate(CV_ADAMS, context_);
        solver_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
        problem_.phase = problem_.in_contact(0, 0);
        CVodeInit(cvode_, derivative, 0, y_);
        CVodeSStolerances(cvode_, relative, absolute);
        CVodeSetUserData(cvode_, &problem_);
        CVodeSetNonlinearSolver(cvode_, solver_);
        CVodeSetMaxNumSteps(cvode_, 100000);
        CVodeSetMaxStep(cvode_, 0.5);  // or it steps over two roots
        CVodeRootInit(cvode_, 3, events);
        CVodeSetNoInactiveRootWarn(cvode_);
    }
    ~Integrator() {
        CVodeFree(&cvode_);
        SUNNonlinSolFree(solver_);
        N_VDestroy(y_);
        SUNContext_Free(&context_);
    }
    Integrator(Integrator const&) = delete;
    Integrator& operator=(Integrator const&) = delete;

    /// Advances to `end`. @return what the mass moved
    double advance(double end) {
        double* const u = N_VGetArrayPointer(y_);
        u[0] = 0;
        CVodeReInit(cvode_, t_, y_);
        CVodeSetStopTime(cvode_, end);
        for (int i = 0; t_ < end; ++i) {
            int const flag = CVode(cvode_, end, y_, &t_, CV_NORMAL);
            if (flag < 0 || i > 10000) throw std::runtime_error("CVODE failed");
            if (flag != CV_ROOT_RETURN) break;
            switch_phase(u);
            CVodeReInit(cvode_, t_, y_);
            CVodeSetStopTime(cvode_, end);
        }
        t_ = end;
        return u[0];
    }
    double v() const {
        return N_VGetArrayPointer(y_)[1];
    }
    double gap() const {
        return N_VGetArrayPointer(y_)[2];
    }

  private:
    void switch_phase(double* u) {
        int found[3] = {0, 0, 0};
        CVodeGetRootInfo(cvode_, found);
        if (problem_.phase == flight) {
            if (u[3] >= 0) return;
            double const impulse = problem_.landing * -u[3];
            u[1] = std::abs(u[1]) <= impulse ? 0 : u[1] - std::copysign(impulse, u[1]);
            u[2] = u[3] = 0;
            problem_.phase = problem_.force(t_) < 0 ? flight : problem_.in_contact(t_, u[1]);
        } else if (found[0] != 0 && problem_.force(t_ + 1e-9) < 0) {
            problem_.phase = flight;
            u[2] = u[3] = 0;
        } else if (problem_.phase == rest) {
            problem_.phase = problem_.needed(t_) < 0 ? forwards : backwards;
        } else if (found[1] != 0) {
            u[1] = 0;
            problem_.phase = problem_.in_contact(t_, 0);
        }
    }

    Problem problem_;
    SUNContext context_ = nullptr;
    N_Vector y_ = nullptr;
    void* cvode_ = nullptr;
    SUNNonlinearSolver solver_ = nullptr;
    double t_ = 0;
};

}  // namespace

double efficiency_by_cvode(Conveyor const& conveyor) {
    Integrator integrator(conveyor);
    double before = HUGE_VAL, v = HUGE_VAL, gap = HUGE_VAL;
    for (int cycle = 1; cycle < most_cycles; ++cycle) {
        double const moved = integrator.advance(two_pi * cycle);
        bool const repeats = std::abs(moved - before) < same && std::abs(integrator.v() - v) < same &&
                             std::abs(integrator.gap() - gap) < same;
        if (repeats) return moved / two_pi;
        before = moved;
        v = integrator.v();
        gap = integrator.gap();
    }
    return NAN;
}

}  // namespace vibrotrough::theory
