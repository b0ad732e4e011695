#pragma once

#include "apps/cli/options.h"
#include "apps/error.h"

/// One function a command; each returns the exit status or throws Error (apps), InputError (sim),
/// SettingsError, DeviceError (render), which main maps to the contract's statuses and one line.
namespace lagomorph::apps {

ExitStatus run_command(const Options&);        // run/commands: simulate and render
ExitStatus simulate_command(const Options&);   // states and energies only
ExitStatus render_command(const Options&);     // pictures from RUN's states
ExitStatus check_command(const Options&);      // a run against its golden
ExitStatus calibrate_command(const Options&);  // check --calibrate: limits for a golden
ExitStatus approve_command(const Options&);    // a run becomes the golden
ExitStatus preview_command(const Options&);    // what a run is, to look at
ExitStatus export_command(const Options&);     // a run's states for other tools
ExitStatus plot_command(const Options&);       // diagrams of a run
ExitStatus compare_command(const Options&);    // two pictures, one verdict
ExitStatus refine_command(const Options&);     // a finer mesh, or one of higher order
ExitStatus info_command(const Options&);       // what a mesh, a scene or a run is
ExitStatus material_command(const Options&);   // a material's energy, stress and stiffness

}  // namespace lagomorph::apps
