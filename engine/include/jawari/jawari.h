// Everything an embedding program needs: description -> compile() -> model -> state -> render(),
// for scenes of strings (compile.h, render.h) and for instruments played by events (instrument_*.h).
#pragma once

#include "jawari/compile.h"
#include "jawari/cost.h"
#include "jawari/description.h"
#include "jawari/energy.h"
#include "jawari/instrument_description.h"
#include "jawari/instrument_model.h"
#include "jawari/instrument_render.h"
#include "jawari/instrument_rungs.h"
#include "jawari/instrument_state.h"
#include "jawari/model.h"
#include "jawari/modes.h"
#include "jawari/obstacles.h"
#include "jawari/quality.h"
#include "jawari/render.h"
#include "jawari/result.h"
#include "jawari/skipping.h"
#include "jawari/state.h"
#include "jawari/step_coefficients.h"
