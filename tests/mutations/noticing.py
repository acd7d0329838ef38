# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests by what they look at, each with the targets that it needs."""

CLOSURES = {f"^unit_{name}$": [f"unit_{name}"] for name in ("drag", "closures", "own_wake", "implicit_drag", "series")}
EXCHANGE = {f"^unit_{name}$": [f"unit_{name}"] for name in ("exchange_stability", "added_mass_exchange", "relaxation",
                                                            "ledger", "books", "crossing", "solid_in_fluids")}
AVERAGING = {"^averaging_kernels$": ["averaging_kernels_test"], "^limit_solid_test.2$": ["limit_solid_test"],
             "^unit_kernel_weights$": ["unit_kernel_weights"], "^unit_row_sums$": ["unit_row_sums"]}
MAPPING = {"^unit_mesh_cut$": ["unit_mesh_cut"], "^remap_test.2$": ["remap_test"], "^mapping_test": ["mapping_test"]}
FORCES = {r"^mock_dem_forces\..*\.1$": ["mock_dem_forces"], "^mock_dem_settling.1$": ["dem_side", "mock_fluid"]}
START = {r"^mock_dem_start\..*\.1$": ["mock_dem_start"]}
SETTLING = {"^pair.batch_settling$": ["foam_side", "dem_side", "demvof", "demvof_pair"]}
DROP = {"^pair.replacement$": ["foam_side", "dem_side", "demvof", "demvof_pair"]}
PAIR = ["foam_side", "dem_side", "demvof", "demvof_pair"]
SHEAR, COMING, CARRIED, STREWN = ({f"^pair.{name}$": PAIR} for name in
                                  ("suspension_viscosity", "coming_and_going", "carried", "extremes"))
FLOW = {"^foam_flow.(MovingPorosity|Displacement)$": ["foam_flow_test"]}
ACROSS = {"^foam_flow.StiffDrag$": ["foam_flow_test"]}
BALANCE = {"^balanced_ranks$": ["balanced_ranks_test"]}
SOLVER = {"^foam_flow.PressureSolver$": ["foam_flow_test"]}
THICK = {"^foam_flow.ThickLiquid$": ["foam_flow_test"]}
ALONE = {"^foam_flow.SameAsInterFoam$": ["foam_flow_test"]}
DRIVEN = {"^pair.driven_channel$": PAIR}
HALF = {"^pair.half_submerged$": PAIR}
FILMS = {"^unit_lubrication$": ["unit_lubrication"], r"^mock_dem_lubrication\..*\.[12]$": ["mock_dem_lubrication"], "^mock_dem_films_ranks$": ["mock_dem_lubrication"],
         r"^mock_dem_film_walls\.": ["mock_dem_film_walls"]}
RIGID = {"^unit_rigid_drag$": ["unit_rigid_drag"]}
CLUMPS = {r"^mock_dem_clumps\.": ["mock_dem_clumps"]}
HISTORY = {r"^mock_dem_history\..*\.1$": ["mock_dem_history"]}
OSCILLATING = {"^pair.oscillating_flow$": PAIR}
OWN_WINDOWS = {"^unit_window_rule$": ["unit_window_rule"], "^unit_seen_fluid$": ["unit_seen_fluid"],
               "^unit_output_due$": ["unit_output_due"]}
MOVING = {"^pair.moving_mesh$": PAIR}
TURNING = {"^pair.turning$": PAIR}
PERIODIC, HALVES, EDGES = ({f"^pair.{name}$": PAIR} for name in ("periodic_mesh", "overlapping_patches", "mesh_edges"))
GRID = {"^unit_bulk_grid$": ["unit_bulk_grid"]}
OWED = {"^unit_owed_pressure$": ["unit_owed_pressure"], "^unit_seen_fluid$": ["unit_seen_fluid"]}
ORDER = {"^unit_seen_fluid$": ["unit_seen_fluid"], "^unit_continuation$": ["unit_continuation"]}
SHAKEN, ROWS = {"^pair.shaken$": PAIR}, {"^unit_gravity_table$": ["unit_gravity_table"]}
BED = {"^mock_foam_bed$": ["foam_side", "mock_particles", "demvof"]}
VIEW, BROWSER = {"^unit_report_view$": ["demvof"]}, {"^browser_view$": ["demvof"]}
STATES = {"^unit_restart_point$": ["unit_restart_point"]}
VERDICT = {"^unit_verdict$": ["unit_verdict"]}
HANDSHAKE = {"^unit_handshake$": ["unit_handshake"], "^faults_mutants_handshake$": ["fuzz_handshake"]}
CASE_FILE = {"^config_bad_case_files$": ["config_bad_case_files"], "^faults_mutants_case_file$": ["fuzz_case_file"]}
GATHERED = {"^unit_gathered_state$": ["unit_gathered_state"]}
LAUNCH = {"^unit_command_line$": ["unit_command_line"]}
ENDINGS = {"^endings$": ["ending_actor"]}
JOB = {"^unit_batch_script$": ["unit_batch_script"]}
CONTINUED, REFUSALS, FIRST_LOOK = ({f"^pair.{name}$": PAIR} for name in ("continued", "refusals", "first_look"))
WRONG_USE = {"^faults_rows$": [*PAIR, "failing_files"]}
NEIGHBOURS = {r"^sparse_exchange_test\.": ["sparse_exchange_test"]}
PARTITION, PLAN = ({f"^unit_{name}$": [f"unit_{name}"]} for name in ("bulk_partition", "exchange_plan"))
LINK = {r"^link_test\.": ["link_test"]}
TOUCHED = {r"^touched_cells_test\.": ["touched_cells_test"], r"^bring_to_owners_test\.": ["bring_to_owners_test"]}
MEMORY = {r"^bulk_memory_test\.": ["bulk_memory_test"], "^averaging_kernels$": ["averaging_kernels_test"]}
SERIES = {r"^vtk_series_test\.": ["vtk_series_test"]}
SPRINGS = {r"^mock_dem_springs\.": ["mock_dem_springs"]}
SOFT_PAIR = {"^pair.soft_springs$": PAIR}
PLACES = {"^faults_places$": [*PAIR, "failing_files"]}
FLOATING, AT_REST, EXTREMES = {"^pair.floating$": PAIR}, {"^pair.beads_at_rest$": PAIR}, {"^pair.extremes$": PAIR}
CLOSED_RANKS, TURBULENT_RANKS, NEW_FACES, LATER_START = ({f"^pair.{name}$": PAIR} for name in ("closed_ranks", "turbulent_ranks", "new_faces", "later_start"))
