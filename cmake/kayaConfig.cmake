# find_package(kaya): kaya_add_joint_model(), KAYA_INCLUDE_DIR, KAYA_PROGRAM.
include("${CMAKE_CURRENT_LIST_DIR}/KayaJointModel.cmake")
