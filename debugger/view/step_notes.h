// What stands beside a step in the right panel: the scene's question, what is wrong with the recording, the run it is compared with.
#pragma once

#include "debugger/view/app.h"

namespace gjkdbg {

/// At the first step: what the scene is, and what is asked of it.
void scene_note(App& app);
/// Of another implementation's run: what a right one would do from here.
void right_note(App& app);
void findings_note(App& app);
/// The first error among a step's findings; null where there is none.
const Finding* error_here(const Session& session);
/// That, before the step's explanation, which takes the step for a right one; in the current font.
void finding_first(App& app);
void beside_note(App& app);

/// The question that a query asks, in a sentence.
const char* question(Query query);

}  // namespace gjkdbg
