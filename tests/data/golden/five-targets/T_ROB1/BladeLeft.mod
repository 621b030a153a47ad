MODULE BladeLeft
    ! Run 0123456789abcdef, task T_ROB1, free blade length 800.0000 mm
    ! Bladewright: the left end of the blade, for irb1600-10-1.45 in the cell irb1600-pair.
    ! 5 targets, 22.0 s of cutting, blade length 800.00 mm.
    ! Start only with all robots at home: the first move is not synchronised.
    ! confdata is [0,0,0,0] and not verified (ConfL is off): check the axis
    ! configuration, the reach and the way from home on the cell, slowly and cold.
    PERS tasks taskList{2} := [["T_ROB1"],["T_ROB2"]];
    VAR syncident syncHome;
    VAR syncident syncReady;
    VAR syncident syncOn;
    VAR syncident syncOff;
    TASK PERS tooldata tBladeLeft := [TRUE,[[0.0000,0.0000,150.0000],[0.50000000,0.50000000,-0.50000000,0.50000000]],[2.5,[0.0000,0.0000,60.0000],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata wBlock := [FALSE,TRUE,"",[[1650.0000,335.0000,500.0000],[0.00000000,0.00000000,0.00000000,1.00000000]],[[0,0,0],[1,0,0,0]]];
    CONST speeddata vTravel := [200,30,5000,1000];
    CONST speeddata vCut := [20.014,10,5000,1000];
    CONST jointtarget jtHome := [[37.2300,25.0300,11.9300,51.6500,-50.4900,-38.8000],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget pApproach := [[690.0000,-120.0000,100.0000],[0.00000000,0.00000000,0.70710678,0.70710678],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0001 := [[690.0000,-20.0000,100.0000],[0.00000000,0.00000000,0.70710678,0.70710678],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0002 := [[689.5000,90.0000,104.0000],[-0.10000000,0.10000000,0.70000000,0.70000000],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0003 := [[689.0000,200.0000,108.0000],[0.00000000,0.00000000,0.70710678,0.70710678],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0004 := [[688.5000,310.0000,112.0000],[-0.10000000,0.10000000,0.70000000,0.70000000],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0005 := [[688.0000,420.0000,116.0000],[0.00000000,0.00000000,0.70710678,0.70710678],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget pRetreat := [[688.0000,520.0000,116.0000],[0.00000000,0.00000000,0.70710678,0.70710678],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    PROC main()
        ConfL \Off;
        SingArea \Off;
        TPWrite "Blade: start only with all robots at home.";
        MoveAbsJ jtHome,vTravel,fine,tBladeLeft\WObj:=wobj0;
        WaitSyncTask syncHome,taskList;
        Set doBladeHeat;
        WaitTime 8;
        WaitSyncTask syncReady,taskList;
        SyncMoveOn syncOn,taskList;
        MoveL pApproach\ID:=10,vTravel\T:=12.3000,fine,tBladeLeft\WObj:=wBlock;
        MoveL p0001\ID:=20,vTravel\T:=0.5000,fine,tBladeLeft\WObj:=wBlock;
        MoveL p0002\ID:=30,vCut\T:=5.5000,z1,tBladeLeft\WObj:=wBlock;
        MoveL p0003\ID:=40,vCut\T:=5.5000,z1,tBladeLeft\WObj:=wBlock;
        MoveL p0004\ID:=50,vCut\T:=5.5000,z1,tBladeLeft\WObj:=wBlock;
        MoveL p0005\ID:=60,vCut\T:=5.5000,fine,tBladeLeft\WObj:=wBlock;
        MoveL pRetreat\ID:=70,vTravel\T:=0.5000,fine,tBladeLeft\WObj:=wBlock;
        SyncMoveOff syncOff;
        Reset doBladeHeat;
    ENDPROC
ENDMODULE
