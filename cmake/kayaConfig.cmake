# find_package(kaya): kaya_add_joint_model(), KAYA_INCLUDE_DIR, KAYA_PROGRAM, and the target kaya::kaya, the library.
include("${CMAKE_CURRENT_LIST_DIR}/KayaJointModel.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/kayaTargets.cmake" OPTIONAL)
