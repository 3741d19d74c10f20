#pragma once
#include "high/top.hpp"
