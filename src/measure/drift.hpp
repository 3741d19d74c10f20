#pragma once

#include "measure/estimate.hpp"

namespace vibrotrough::measure {

/// What is probably left of a start-up that all runs share in the mean of the cycles kept, in size.
///
/// Runs that start on both sides of the steady value show a start-up in their difference, but not one that
/// drifts the same way in all of them. Many short runs then give a narrow interval about a wrong mean (Glynn
/// & Heidelberger, ACM Transactions on Modeling and Computer Simulation 1, 1991, 3-23). Decays y = a + b f(i)
/// are therefore fitted by least squares: exponentials with the decay times n, n/2, n/4 and n/8 to all n
/// cycles, and c / i to those from n/16 on, which is what layers were seen to do (throw number 1.2 of
/// tests/measure/reference). Each leaves B = b F in the mean, with the mean F of f over the cycles kept. As b
/// is fitted to each run, the scatter of B over the runs gives its standard error s, whatever the correlation
/// between cycles and the offsets between runs, but not less than independent cycles imply. Of B, sqrt(max(0,
/// B^2 - 2 s^2)) counts, so that noise counts rarely.
///
/// The largest of these is returned, over c / i and those exponentials that agree with the cycles: whose sum
/// of squares exceeds that of the best by at most nine times the variance of a cycle's mean over the runs
/// (three standard deviations).
/// @param runs       at least one
/// @param discarded  cycles that are left out of the mean
/// @return 0 for a single run, or fewer than eight cycles
double drift_left(Runs runs, int discarded);

}  // namespace vibrotrough::measure
