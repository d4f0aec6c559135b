#pragma once

/// What the library compiles once for each degree and dimension it ships: X(degree, spacedim) for all of them.
#define SHERD_FOR_EACH_SURFACE(X) X(2, 2) X(3, 2) X(4, 2) X(2, 3) X(3, 3) X(4, 3)
