#pragma once

#include <pybind11/numpy.h>

namespace vibrotrough::atlas {

/// A column of numbers.
using Column = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Adds the functions of the atlas to the module for Python.
void add_to(pybind11::module_& module);

}  // namespace vibrotrough::atlas
