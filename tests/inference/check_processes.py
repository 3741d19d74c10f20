"""Compares Gaussian processes of this program with scikit-learn's on the same data.

usage: check_processes.py WRITE_PROCESSES
Likelihood, predictions and leave-one-out at given hyperparameters must agree to 1e-6; where hyperparameters were fitted,
scikit-learn's own search must find the same largest likelihood to 1e-6 and not a larger one.
"""

import json
import subprocess
import sys
import warnings

import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Kernel, Matern, WhiteKernel

TOLERANCE = 1e-6


class Columns(Kernel):
    """A kernel that sees only the columns of the inputs."""

    def __init__(self, kernel, first, last):
        self.kernel, self.first, self.last = kernel, first, last

    @property
    def theta(self):
        return self.kernel.theta

    @theta.setter
    def theta(self, value):
        self.kernel.theta = value

    @property
    def bounds(self):
        return self.kernel.bounds

    @property
    def hyperparameters(self):
        return self.kernel.hyperparameters

    def get_params(self, deep=True):
        return {"kernel": self.kernel, "first": self.first, "last": self.last}

    def clone_with_theta(self, theta):
        return Columns(self.kernel.clone_with_theta(theta), self.first, self.last)

    def cut(self, x):
        return None if x is None else x[:, self.first:self.last]

    def __call__(self, X, Y=None, eval_gradient=False):
        return self.kernel(self.cut(X), self.cut(Y), eval_gradient)

    def diag(self, X):
        return self.kernel.diag(self.cut(X))

    def is_stationary(self):
        return False


class Trend(Kernel):
    """Covariance of a linear trend whose coefficients have the same variance; no hyperparameters."""

    def __init__(self, variance=1.0):
        self.variance = variance

    def __call__(self, X, Y=None, eval_gradient=False):
        covariance = self.variance * X @ (X if Y is None else Y).T
        return (covariance, np.empty((len(X), len(X), 0))) if eval_gradient else covariance

    def diag(self, X):
        return self.variance * np.sum(X**2, axis=1)

    def is_stationary(self):
        return False


def kernel_of(one, bounds):
    inputs = len(one["lengths"])
    matern = ConstantKernel(one["deviation"]**2, (1e-6, 9) if bounds else "fixed") * Matern(
        one["lengths"], (0.05, 20) if bounds else "fixed", nu=1.5)
    kernel = Columns(matern, 0, inputs) + Columns(Trend(), inputs, inputs + 2)
    if one["has_extra_noise"]:
        kernel += WhiteKernel(max(one["extra_noise"]**2, 1e-8), (1e-8, 1) if bounds else "fixed")
    return kernel


def process(one, rows, bounds=False):
    """scikit-learn's process on some rows of the data, for the values minus the mean of the trend."""
    x = np.hstack([np.array(one["inputs"]), np.array(one["trend"])])[rows]
    y = (np.array(one["values"]) - np.array(one["trend"])[:, 1])[rows]
    regressor = GaussianProcessRegressor(kernel_of(one, bounds), alpha=np.array(one["noise"])[rows]**2,
                                         optimizer="fmin_l_bfgs_b" if bounds else None,
                                         n_restarts_optimizer=15 if bounds else 0, random_state=1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of hyperparameters at their bounds
        return regressor.fit(x, y)


def compare(what, ours, theirs, tolerance=TOLERANCE):
    if not abs(ours - theirs) <= tolerance * max(1.0, abs(theirs)):
        sys.exit(f"{what}: {ours!r}, but scikit-learn has {theirs!r}")


def check(one, number):
    everything = np.arange(len(one["values"]))
    regressor = process(one, everything)
    compare(f"process {number}: log likelihood", one["log_likelihood"], regressor.log_marginal_likelihood_value_)
    for point in one["predictions"]:
        mean, deviation = regressor.predict([point["inputs"] + point["trend"]], return_std=True)
        # WhiteKernel is noise of a measurement and not part of the function.
        variance = deviation[0]**2 - (one["extra_noise"]**2 if one["has_extra_noise"] else 0)
        compare(f"process {number}: mean", point["mean"], mean[0] + point["trend"][1])
        compare(f"process {number}: variance", point["sd"]**2, variance)
    for i, left_out in enumerate(one["leave_one_out"]):
        others = np.delete(everything, i)
        mean, deviation = process(one, others).predict([one["inputs"][i] + one["trend"][i]], return_std=True)
        compare(f"process {number}: mean without value {i}", left_out["mean"], mean[0] + one["trend"][i][1])
        compare(f"process {number}: sd without value {i}", left_out["sd"], np.hypot(deviation[0], one["noise"][i]))
    if one["is_fitted"]:
        best = process(one, everything, bounds=True).log_marginal_likelihood_value_
        compare(f"process {number}: largest log likelihood", one["log_likelihood"], best)


def main():
    processes = json.loads(subprocess.run([sys.argv[1]], check=True, stdout=subprocess.PIPE).stdout)
    for number, one in enumerate(processes):
        check(one, number)
    print(f"{len(processes)} processes agree with scikit-learn to {TOLERANCE:g}")


if __name__ == "__main__":
    main()
