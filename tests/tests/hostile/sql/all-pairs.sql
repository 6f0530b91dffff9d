SELECT count(*) FROM rooms r0, rooms r1, rooms r2, rooms r3, rooms r4, rooms r5, rooms r6, rooms r7, rooms r8, rooms r9, rooms r10, rooms r11, rooms r12, rooms r13, rooms r14, rooms r15
