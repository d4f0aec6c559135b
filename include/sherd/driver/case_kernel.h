#pragma once

#include <sherd/driver/case_model.h>
#include <sherd/solve/monolithic_solver.h>
#include <sherd/time/any_integrator.h>

/// What the kernel units of the program sherd instantiate, one set for each degree and dimension (src/driver/kernels).
