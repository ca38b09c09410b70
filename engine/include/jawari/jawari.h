// Everything an embedding program needs: description -> compile() -> model -> state -> render().
#pragma once

#include "jawari/compile.h"
#include "jawari/description.h"
#include "jawari/energy.h"
#include "jawari/model.h"
#include "jawari/modes.h"
#include "jawari/obstacles.h"
#include "jawari/render.h"
#include "jawari/result.h"
#include "jawari/state.h"
#include "jawari/step_coefficients.h"
