# Which test runs in which build, by regular expressions of names without the build's prefix. The build `ci` runs all
# of them; what the others cannot tell from it they leave out (CONTRIBUTING.md, "Which build runs what"). A program
# that no test of this build runs is not built by default, but by its name.

# Text, and programs outside of the tree: neither a sanitizer nor another precision is in them. Of installations and
# headers there is more to know in double precision (tests/install, tests/structure).
set(KARMA_ONCE
  structure.includes structure.policy structure.style structure.format structure.joints structure.comments
  docs.* api.coverage tutorials.page tutorials.generator tutorials.run
  tutorials.setup tutorials.browser)

# Sanitizers: what is measured in long runs of code that other tests run, too, sanitized; and what reference
# algorithms of the tests themselves take most of the time of.
set(KARMA_ONCE_WITHOUT_SANITIZERS
  install.programs viewer.interface sweep.settings
  scenes.arm scenes.faults scenes.linkage scenes.motor scenes.rings scenes.scenes
  Mcd.BoxBox Mcd.Ccd Mcd.Guess Mcd.RandomPoses Mcd.Sampled Mcd.Sliding
  Mdt.Certificate Mdt.Degenerate Mdt.MisfitScenes Mdt.Order
  Mst.Blows Mst.Cases_Crowds Mst.Cases_Long Mst.Cases_Stacks Mst.Cases_Terrain Mst.Choice
  Mst.Collapse Mst.Crowd Mst.Forces Mst.Jointed Mst.Order_Contacts Mst.Reuse Mst.Scales Mst.Spikes Mst.WarmSteps Mst.WorkBudget
  Mst.Threads) # ThreadSanitizer's build runs it, and states.twelve sanitizes the same workers

# Double precision: what asserts the same of both (no TOL(), no _ME_API_DOUBLE) and has no arithmetic of MeReal in it;
# pictures; and convex shapes, which Mcd has in double in each build.
set(KARMA_ONCE_IN_SINGLE
  scenes.linkage scenes.rings Mcd.BoxBox Mcd.Ccd Mcd.Convex Mcd.Guess Mcd.RandomPoses Mcd.Sampled Mcd.Threads
  Mst.Advise Mst.Callbacks Mst.Cases_Long Mst.Memory Mst.Threads states.longrun
  MeApp.window viewer.Picture viewer.Up viewer.interface viewer.runs viewer.window tutorials.advise install.programs fuzz.files)

# 1 s and more in the build `ci`, of a processor; everything else is labelled `quick`.
set(KARMA_DEAR
  docs.* fuzz.* install.* sweep.* tutorials.* api.coverage
  structure.format structure.headers structure.build_types structure.policy states.*
  MeApp.window viewer.Picture viewer.Up viewer.interface viewer.runs viewer.window
  scenes.faults scenes.instructions scenes.linkage scenes.rings scenes.scenes
  Mcd.BoxBox Mcd.Ccd Mcd.Convex Mcd.Guess Mcd.MassProperties Mcd.MeshQuery Mcd.RandomPoses Mcd.Sampled Mcd.Threads
  Mcd.TriangleList
  Mdt.Certificate Mdt.MisfitScenes Mdt.Order Mdt.RandomScenes
  Mst.Advise Mst.Blows Mst.Callbacks Mst.Cases_Crowds Mst.Cases_Impacts Mst.Cases_Long Mst.Cases_Stacks
  Mst.Cases_Terrain Mst.Choice Mst.Continuous Mst.ConvexType Mst.Crowd Mst.Forces Mst.Grounds Mst.Heaps
  Mst.Jointed Mst.Memory Mst.Reuse Mst.Scales Mst.Spikes Mst.SweptMovers
  Mst.Threads Mst.WarmSteps Mst.WorkBudget)

# karma_is_listed(<variable> <name> <expression> ...)
function(karma_is_listed variable name)
  set(${variable} OFF PARENT_SCOPE)
  foreach(listed ${ARGN})
    if(name MATCHES "^${listed}$")
      set(${variable} ON PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# karma_is_run(<variable> <name>): in this build.
function(karma_is_run variable name)
  set(left_out "")
  if(KARMA_SANITIZE AND NOT KARMA_TESTS STREQUAL THREADS)
    list(APPEND left_out ${KARMA_ONCE} ${KARMA_ONCE_WITHOUT_SANITIZERS})
  endif()
  if(KARMA_PRECISION STREQUAL double)
    list(APPEND left_out ${KARMA_ONCE} ${KARMA_ONCE_IN_SINGLE})
  endif()
  karma_is_listed(is_left_out ${name} ${left_out})
  if(is_left_out AND NOT KARMA_TESTS_ALL)
    set(${variable} OFF PARENT_SCOPE)
  else()
    set(${variable} ON PARENT_SCOPE)
  endif()
endfunction()
