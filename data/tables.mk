# The tables and figures, by name, in the order of the paper. What each one is says `make list`, its page, and the head of
# the program or script of the same name: data/scenes/NAME.toml, src/NAME.cpp or studies/NAME.cpp or .py, figures/NAME.gp or .py.

# The paper's figures and tables, and what its claims are judged by: computed by `make all`, for both readings of Table 1.
paper := fig01_bearing fig02_ball_position tab01_parameters fig03_response fig04_displacements fig05_displacements \
  fig06_orbits fig07_contact fig08_orbits fig09_contact regimes tab02_timing
# Computed by `make all`, for the exchanged reading alone.
beside := deviations sampling runup bound

# Long studies, computed by `make studies`; data/reference keeps their tables.
studies := attractors validity stability verdicts adaptive hard_cases sensitivity identification robustness cage \
  clearance_speed clearance_stiffness stiffness_border
# The same, but timed: alone on the machine.
costs := tab02_equal_error work_precision cost_growth large map_scaling tab03_answers
# Of these by Snakemake, from studies/NAME.yaml.
maps := clearance_speed clearance_stiffness stiffness_border
# By explore, from studies/NAME.py.
scripts := adaptive attractors bound cage hard_cases identification large map_scaling robustness runup sampling sensitivity stability validity verdicts
# By other people's programs, from peers/NAME.py.
peers := peers peers_auto

# What is drawn: from a table of the same name, sections from attractors, truncation from validity.
drawn := fig01_bearing fig02_ball_position fig03_response fig04_displacements fig05_displacements fig06_orbits fig07_contact \
  fig08_orbits fig09_contact sections truncation validity
drawn_beside := stability verdicts adaptive sampling runup hard_cases sensitivity identification robustness cage work_precision cost_growth large \
  clearance_speed clearance_stiffness stiffness_border peers tab03_answers
